#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Rows of a band, which one thread draws at a time; what is drawn in one does not depend on the others. 32 rows of
/// four float planes 1920 wide are just under a megabyte and stay in the second-level cache.
inline constexpr int band_rows = 32;
constexpr int band_count(int height) { return (height + band_rows - 1) / band_rows; }

/// Draws one layer's strokes, in their order and as seen from the position `view`, over the canvas against which the
/// next layer is planned. Antialiased; a stroke's cover is the largest of its dabs', so that it is not darker where it
/// crosses itself. Parallel over bands of rows; the same bytes on any number of threads. `brush` leaves the paint.
/// `wanted`: 0 for bands that are left as they are; empty: all are drawn.
void rasterise(const Layer& layer, ViewPosition view, const Hiding& hiding, Canvas& canvas, const Brush& brush = {},
               std::span<const std::uint8_t> wanted = {});

/// Work on the rows of a canvas from `top` on, which alone exist.
using CanvasBandWork = std::function<void(int top, Canvas& canvas)>;

/// As rasterise, band by band: `begin` fills a band of the canvas, and `finish` takes it with the strokes. Both may be
/// called for several bands at once.
void rasterise_bands(const Layer& layer, ViewPosition view, const Hiding& hiding, int width, int height,
                     const Brush& brush, const CanvasBandWork& begin, const CanvasBandWork& finish);

/// The pixels that strokes would leave bare if they were drawn in this way over a canvas whose bare pixels are not 0 in
/// `bare`. Costs little if few pixels are bare.
Image<std::uint8_t> left_bare(const Layer& layer, ViewPosition view, const Hiding& hiding, Image<std::uint8_t> bare,
                              const Brush& brush = {});

}  // namespace wheatstone
