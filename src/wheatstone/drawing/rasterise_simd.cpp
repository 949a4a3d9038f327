#include <algorithm>
#include <cstdint>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/rasterise_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/drawing/stroke_paint_simd_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The brush's cover, 0..1, from squared distances.
struct Cover {
  explicit Cover(const BrushProfile& brush)
      : squared_reach(hn::Set(Floats(), brush.reach_px * brush.reach_px)),
        slope(hn::Set(Floats(), -1 / brush.rim_px)),
        offset(hn::Set(Floats(), brush.middle_px / brush.rim_px + 0.5f)) {}

  bool is_zero(hn::Vec<Floats> squared) const { return hn::AllFalse(Floats(), hn::Lt(squared, squared_reach)); }
  hn::Vec<Floats> of(hn::Vec<Floats> squared) const {
    const auto cover = hn::MulAdd(hn::Sqrt(squared), slope, offset);
    return hn::Min(hn::Max(cover, hn::Zero(Floats())), hn::Set(Floats(), 1.f));
  }

  hn::Vec<Floats> squared_reach, slope, offset;
};

/// Columns of a block in one row: a bit each, from the lowest.
struct ColumnsOfBlock {
  int row, number;
  std::uint32_t columns;
};

/// Composites paint under some open columns of a block; `paint_at(i)` is the paint of a vector from the block's column
/// `i` on.
template <bool varies, class PaintAt>
HWY_INLINE void slide_under_block(const Paint<varies>& paint, const ColumnsOfBlock& within,
                                  FrontToBackAccumulator& accumulator, PaintAt paint_at) {
  const Floats f;
  FrontToBackAccumulator::Block& block = accumulator.block(within.row, within.number);
  FrontToBackAccumulator::Cover* const most = accumulator.cover(within.row, within.number);
  std::uint32_t open = 0;
  for (int i = 0; i < FrontToBackAccumulator::block_px; i += static_cast<int>(hn::Lanes(f))) {
    PaintHere here = paint_at(i);
    here.cover = hn::IfThenElseZero(lanes_of(within.columns >> i), here.cover);
    if (most != nullptr) hn::StoreU(hn::Max(here.cover, hn::LoadU(f, most->data() + i)), f, most->data() + i);
    open |= paint.slide_under(here, block, i);
  }
  accumulator.set_open_columns(within.row, within.number, open);
}

/// Composites a measured stroke under what is drawn; `paint_at(row, x)` is the paint of a vector.
template <bool varies, class PaintAt>
HWY_INLINE void slide_band_under(const StrokeInBand& of, const DistanceBand& band, FrontToBackAccumulator& accumulator,
                                 PaintAt paint_at) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const Paint<varies> paint(of.stroke);
  for (int row = band.first_row; row < band.end_row; ++row) {
    for (int number = band.begin[row] / block_px; number * block_px < band.end[row]; ++number) {
      const std::uint32_t open =
          accumulator.open_columns(row, number) & of.hidden_below.shown_columns_in(row, number, band.row_count);
      if (open == 0) continue;
      slide_under_block(paint, {row, number, open}, accumulator,
                        [&](int i) { return paint_at(row, number * block_px + i); });
    }
  }
}

void draw_under(const StrokeInBand& of, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  const auto& [layer, stroke, below, brush] = of;
  const Cover cover{BrushProfile(stroke.radius_px)};
  find_extents(layer, stroke, accumulator.width(), 0, band);
  bool is_seen = false;
  for (int row = band.first_row; row < band.end_row; ++row) {
    if (band.begin[row] >= band.end[row]) continue;
    accumulator.clamp(row, band.begin[row], band.end[row]);
    if (band.begin[row] >= band.end[row]) continue;
    is_seen = true;
    // Whole blocks are looked at.
    constexpr int block_px = FrontToBackAccumulator::block_px;
    band.begin[row] -= band.begin[row] % block_px;
    band.end[row] += block_px - 1 - (band.end[row] - 1) % block_px;
  }
  if (!is_seen) return;
  measure_distances(stroke, below, of.varies(), band);
  const auto zero = hn::Zero(Floats()), one = hn::Set(Floats(), 1.f);
  if (of.varies()) {
    const Bristles bristles(stroke, brush);
    slide_band_under<true>(of, band, accumulator, [&](int row, int x) -> PaintHere {
      const Bristles::Paint paint = paint_of_row(bristles, band, row, x);
      return {hn::Min(hn::Max(paint.cover, zero), one), paint.share, paint.tone};
    });
    return;
  }
  slide_band_under<false>(of, band, accumulator, [&](int row, int x) -> PaintHere {
    const float* squared = band.squared.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(band.stride);
    return {cover.of(hn::LoadU(Floats(), squared + x)), zero, zero};
  });
}

/// Lays the rows of a block over a canvas. Where no light comes through, some stroke covers it.
void lay_block_over(const FrontToBackAccumulator::Block& block, const FrontToBackAccumulator::Cover& cover, int x,
                    int y, Canvas& canvas) {
  const Floats f;
  const auto dark = hn::Set(f, FrontToBackAccumulator::dark), whole = hn::Set(f, 1.f);
  for (int i = 0; i < FrontToBackAccumulator::block_px; i += static_cast<int>(hn::Lanes(f))) {
    const auto light = hn::Load(f, block.light + i);
    const auto lay = [&](const float* drawn, Image<float>& plane) {
      float* const to = plane.row(y).data() + x + i;
      hn::StoreU(hn::MulAdd(light, hn::LoadU(f, to), hn::Load(f, drawn + i)), f, to);
    };
    lay(block.red, canvas.red);
    lay(block.green, canvas.green);
    lay(block.blue, canvas.blue);
    float* const coverage = canvas.coverage.row(y).data() + x + i;
    const auto covered = hn::IfThenElse(hn::Le(light, dark), whole, hn::LoadU(f, cover.data() + i));
    hn::StoreU(hn::Max(hn::LoadU(f, coverage), covered), f, coverage);
  }
}

void lay_band_over(FrontToBackAccumulator& accumulator, int top, Canvas& canvas) {
  for (int row = 0; row < accumulator.rows(); ++row)
    for (int number = 0; number < accumulator.block_count(); ++number)
      if (accumulator.is_touched(row, number))
        lay_block_over(accumulator.block(row, number), *accumulator.cover(row, number),
                       number * FrontToBackAccumulator::block_px, top + row, canvas);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(draw_under);
HWY_EXPORT(lay_band_over);

void draw_stroke_under(const StrokeInBand& stroke, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(draw_under)(stroke, band, accumulator);
}

void lay_over(FrontToBackAccumulator& accumulator, int top, Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(lay_band_over)(accumulator, top, canvas);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
