#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "wheatstone/drawing/rasterise.h"
#include "wheatstone/strokes/begun_canvas.h"

namespace wheatstone {

/// Rows of a canvas from the row `top` of a layer's pictures on. Borrows the canvas.
struct CanvasRows {
  const Canvas& canvas;
  int top = 0;
};

/// Makes rows [first, end) of the begun canvas without its strokes; `to` begins at the row `top`. Only where the factor
/// is above 1.
void enlarge_rows(const BegunCanvas& begun, int first, int end, Canvas& to, int top = 0);
/// All rows.
Canvas enlarged_canvas(const BegunCanvas& begun);

/// Calls `work(rows, first, end)` for all rows [first, end) of the layer's pictures, band after band. `rows` holds the
/// begun canvas from `margin_px` above a band to as much below it. Only for a canvas without strokes.
template <class Work>
void for_each_band(const BegunCanvas& begun, int margin_px, Work work) {
  assert(begun.strokes == nullptr);
  if (begun.factor == 1) return work(CanvasRows{begun.canvas}, 0, begun.height);
  const int rows_of_band = std::max(256, 2 * margin_px);
  for (int first = 0; first < begun.height; first += rows_of_band) {
    const int end = std::min(first + rows_of_band, begun.height);
    const int top = std::max(first - margin_px, 0), bottom = std::min(end + margin_px, begun.height);
    Canvas canvas(begun.width, bottom - top, {});
    enlarge_rows(begun, top, bottom, canvas, top);
    work(CanvasRows{canvas, top}, first, end);
  }
}

/// Calls `work(canvas, row, y)` for each row y of the layer's pictures, in parallel: it is the canvas's row `row`.
template <class Work>
void for_each_row(const BegunCanvas& begun, Work work) {
  if (begun.factor == 1) {
    tbb::parallel_for(0, begun.height, [&](int y) { work(begun.canvas, y, y); });
    return;
  }
  static const StrokesToDraw none;
  const auto& [layer, view, hiding, brush] = begun.strokes == nullptr ? none : *begun.strokes;
  rasterise_bands(
      layer, view, hiding, begun.width, begun.height, brush,
      [&](int top, Canvas& canvas) { enlarge_rows(begun, top, top + canvas.height, canvas, top); },
      [&](int top, const Canvas& canvas) {
        for (int row = 0; row < canvas.height; ++row) work(canvas, row, top + row);
      });
}

/// The canvas's colours, bare or painted, each rounded to the nearest level.
Image<Rgb8> picture_of(const BegunCanvas& begun);

/// 255 where the canvas is bare, as far as it is wanted: `wanted` is not 0 there, or empty.
Image<std::uint8_t> bare_pixels(const BegunCanvas& begun, ImageView<const std::uint8_t> wanted);

}  // namespace wheatstone
