#pragma once

#include "wheatstone/painting/canvas.h"
#include "wheatstone/painting/painting.h"

namespace wheatstone {

/// Draws one layer's strokes over a canvas, in their order, as the view position `view` sees them: what the next layer
/// is planned against. Antialiased; a stroke's cover is the largest of its dabs', so that where it crosses itself it is
/// not darker. Parallel over bands of rows; the same bytes on any number of threads.
void rasterise(const Layer& layer, float view, Canvas& canvas);

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
DrawnView draw(const Painting& painting, float view, const DrawOptions& options = {});

}  // namespace wheatstone
