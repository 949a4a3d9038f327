#pragma once

#include <span>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// A view beside the eyes: what it sees of what the photographs show, and the part that they do not show, where the
/// farther surface beside it goes on, with its colours mirrored.
struct OuterView {
  ViewPosition position;
  Image<Rgb8> picture;
  Image<float> disparity;         ///< in the picture's pixels; no unknowns
  Image<std::uint8_t> uncovered;  ///< 255 for what no photograph shows
  int left_px = 0;                ///< column of the photographs at which the pictures begin
  int reduction = 1;              ///< so many pixels of the photographs become one
};

/// Borrows it.
SceneView scene_view_of(const OuterView& view);

/// A reduced view `factor` times as large, which divides its reduction; what the smaller pictures left out at the
/// border is as beside it.
OuterView enlarged(const SceneView& view, int factor, int width, int height);

/// A scene whose views are all in pictures of the reference view's size. Borrows the views that are.
class WholeScene {
 public:
  explicit WholeScene(std::span<const SceneView> views);
  WholeScene(const WholeScene&) = delete;
  WholeScene& operator=(const WholeScene&) = delete;
  ~WholeScene() = default;

  std::span<const SceneView> views() const { return views_; }

 private:
  std::vector<OuterView> larger_;
  std::vector<SceneView> views_;
};

/// What a view beside the eyes sees, in pictures of the photographs' size. They are shifted by whole pixels so that a
/// point of the disparity `zero_parallax_px` has about the same column in them as in the central view: they show what a
/// display shows.
OuterView make_outer_view(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewPosition view,
                          float zero_parallax_px);

}  // namespace wheatstone
