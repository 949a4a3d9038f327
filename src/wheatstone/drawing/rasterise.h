#pragma once

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Draws one layer's strokes over a canvas, in their order, as far as the view position `view` sees them: what the next
/// layer is planned against. Antialiased; a stroke's cover is the largest of its dabs', so that where it crosses itself
/// it is not darker. Parallel over bands of rows; the same bytes on any number of threads. `brush` leaves the paint.
void rasterise(const Layer& layer, ViewPosition view, const Hiding& hiding, Canvas& canvas, const Brush& brush = {});

/// What strokes would leave bare if they were drawn so over a canvas whose bare pixels are not 0 in `bare`. Costs
/// little where few are.
Image<std::uint8_t> left_bare(const Layer& layer, ViewPosition view, const Hiding& hiding, Image<std::uint8_t> bare,
                              const Brush& brush = {});

}  // namespace wheatstone
