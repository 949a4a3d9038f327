#pragma once

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// A painting as one view sees it.
struct DrawnView {
  Image<Rgb8> picture;
  double bare_share = 0;     ///< share of the pixels, 0..1, of which strokes cover less than half
  Image<std::uint8_t> bare;  ///< 255 for those pixels, 0 for the others
  Image<float> disparity;    ///< of the stroke that covers half of a pixel, NaN where none does; empty unless asked for
};

struct DrawOptions {
  ImageView<const Rgb8> background;  ///< of the painting's size; empty: the painting's canvas colour
  bool with_disparity = false;
};

/// Draws a whole painting for one view over its background. Works from the nearest stroke to the farthest and leaves
/// out what is hidden; the picture is that of `rasterise`, layer by layer, within rounding.
DrawnView draw(const StrokePainting& painting, ViewPosition view, const DrawOptions& options = {});

/// Draws the marks for one view, antialiased, every point moved by its own disparity. A mark covers the earlier ones
/// unless it lies behind them by more than a pixel of disparity, so that sloped surfaces hide each other correctly.
/// What no mark covers counts as bare, and takes the colour of the farther of its two neighbours on the row. The same
/// bytes on any number of threads.
DrawnView draw(const RegionPainting& painting, ViewPosition view);

/// Draws the lines for one view, every point moved by its own disparity, and fills the space between them by
/// the Laplace equation, starting from a pull-push pyramid. The same bytes on any number of threads. Only a painting
/// without lines is bare; it is grey.
DrawnView draw(const DiffusionPainting& painting, ViewPosition view);

/// Draws a painting for one view as its kind of marks is drawn; strokes over their canvas colour.
DrawnView draw(const Painting& painting, ViewPosition view);

}  // namespace wheatstone
