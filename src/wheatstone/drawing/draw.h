#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "wheatstone/gpu/gpu.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/slicing.h"

namespace wheatstone {

/// A painting as one view sees it.
struct DrawnView {
  Image<Rgb8> picture;
  double bare_share = 0;     ///< share of the pixels, 0..1, of which marks cover less than half
  Image<std::uint8_t> bare;  ///< 255 for those pixels, 0 for the others
  Image<Rgb16> deep = {};    ///< the picture with 16 bits a channel, where DrawOptions::deep asks for it
};

/// Which parts of a painting are drawn.
struct DrawOptions {
  Placement placement;
  Slicing slicing = {};  ///< of strokes
  bool relief = true;    ///< light the paint of a painting that has relief
  bool deep = false;     ///< also draw DrawnView::deep. Only the processor does, of strokes; others leave it empty
};

/// A painting prepared for drawing: everything that is the same in all views. Strokes are flattened into segments,
/// sorted into bands of rows, and placed in the central view with their disparities, so that a view only moves them
/// along their rows.
class PreparedPainting {
 public:
  struct Contents;
  explicit PreparedPainting(std::unique_ptr<Contents> contents);
  PreparedPainting(PreparedPainting&&) noexcept;
  PreparedPainting& operator=(PreparedPainting&&) noexcept;
  ~PreparedPainting();

  int width() const;
  int height() const;
  const Contents& contents() const { return *contents_; }
  Contents& contents() { return *contents_; }

 private:
  std::unique_ptr<Contents> contents_;
};

/// Does the work that all views of a painting share. A graphics processor keeps the painting until the prepared
/// painting is destroyed. If Device::graphics was asked for, and there is no graphics processor or it fails,
/// Error{wrong_usage} is thrown, here or when a view is drawn. Its pictures equal those of the processor except in the
/// last bits of a few pixels, and they are the same bytes each time.
PreparedPainting prepare(const Painting& painting, const DrawOptions& options = {}, Device device = Device::processor);

/// Draws a painting for one view, at any place on the line through the eyes: every point of a mark is moved by its own
/// disparity, and a mark does not cover a pixel where one of the painting's surfaces lies before it. Strokes lie over
/// `background`, of the pictures' size, or over their canvas colour where it is empty. Pixels that no region covers
/// take the colour of the farther of their two neighbours on the row. Colours of lines spread by the Laplace equation
/// over the area between them, which leaves nothing bare. The same bytes on any number of threads.
DrawnView draw(const PreparedPainting& painting, ViewPosition view, ImageView<const Rgb8> background = {});

/// The same for many views at once, one for each position, in their order. They cost little more than a few views,
/// because a stroke is made once for all of them (as the fragments of splats are, Hassaine 2010, sec. 4.5). There is a
/// background for each view, or none.
std::vector<DrawnView> draw(const PreparedPainting& painting, std::span<const ViewPosition> views,
                            std::span<const ImageView<const Rgb8>> backgrounds = {});

/// Receives a drawn view, and its place among the requested positions.
using ViewSink = std::function<void(std::size_t place, DrawnView view)>;

/// The same, but each view is passed to `take` when it is drawn: only a few views are in memory at a time.
void draw(const PreparedPainting& painting, std::span<const ViewPosition> views, const ViewSink& take,
          std::span<const ImageView<const Rgb8>> backgrounds = {});

/// Adds strokes on top of a prepared painting of strokes without relief, and draws a view again that `draw` gave, over
/// the same background: the bands of rows that the strokes touch, on the processor. The same bytes as if the painting
/// had had the strokes at the end of its last layer, where the processor drew the view, too.
void draw_over(PreparedPainting& painting, const Layer& strokes, ViewPosition view, ImageView<const Rgb8> background,
               DrawnView& drawn);

/// Draws views of a painting again. At first, `pictures` are those of the same views of the painting `before`, drawn
/// over its canvas colour. Of strokes without relief, the processor draws only the bands of rows in which strokes or
/// surfaces differ. The same bytes as `draw`.
void draw_again(const PreparedPainting& painting, const PreparedPainting& before, std::span<const ViewPosition> views,
                std::span<Image<Rgb8>> pictures);

/// Whether the processor draws the painting.
bool is_drawn_by_processor(const PreparedPainting& painting);

/// Prepares a painting and draws one view of it.
DrawnView draw(const Painting& painting, ViewPosition view);

}  // namespace wheatstone
