#pragma once

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Draws one layer's strokes, in their order and as seen from the position `view`, over the canvas against which the
/// next layer is planned. Antialiased; a stroke's cover is the largest of its dabs', so that it is not darker where it
/// crosses itself. Parallel over bands of rows; the same bytes on any number of threads. `brush` leaves the paint.
void rasterise(const Layer& layer, ViewPosition view, const Hiding& hiding, Canvas& canvas, const Brush& brush = {});

/// The pixels that strokes would leave bare if they were drawn in this way over a canvas whose bare pixels are not 0 in
/// `bare`. Costs little if few pixels are bare.
Image<std::uint8_t> left_bare(const Layer& layer, ViewPosition view, const Hiding& hiding, Image<std::uint8_t> bare,
                              const Brush& brush = {});

}  // namespace wheatstone
