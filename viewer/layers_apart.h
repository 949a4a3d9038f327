#pragma once

#include <memory>
#include <vector>

#include "compose.h"
#include "output_mode.h"
#include "view_state.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone::viewer {

/// Paint alone: black and transparent where there is none.
struct LayerPicture {
  Image<Rgb8> paint;
  Image<std::uint8_t> cover;  ///< 255 where it covers
};

/// A painting's layers of strokes, standing one before the other like panes of glass, the canvas behind them, looked at
/// from a side (Stavrakis & Gelautz 2004, fig. 5). A slicing plane is a frame, which stands half a gap before its layer
/// where it is at the nearest stroke, and half a gap behind it at the farthest. Keeps the drawn layers, so that turning
/// draws none anew. Of one thread.
class LayersApart {
 public:
  /// Both eyes' pictures. The painting has layers.
  std::vector<Image<Rgb8>> draw(const std::shared_ptr<const Painting>& painting, const ViewState& state,
                                const PictureSize& size);
  /// The planes in the left eye's picture that was drawn last.
  const std::vector<PlaneFrame>& planes() const { return planes_; }

 private:
  void draw_layers(const std::shared_ptr<const Painting>& painting, const ViewState& state, const PictureSize& size);

  std::shared_ptr<const Painting> painting_;
  Slicing slicing_;
  std::vector<float> plane_shares_;  ///< of the planes, from that of the finest layer on
  std::vector<PlaneFrame> planes_;   ///< likewise
  double scale_ = 0;
  EyePositions eyes_;
  std::vector<std::vector<LayerPicture>> layers_of_eyes_;
};

/// Whether a painting is of layers that can stand apart.
bool can_stand_apart(const Painting& painting);

}  // namespace wheatstone::viewer
