#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/rasterise_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;

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

/// A bit for each lane, from the lowest.
HWY_INLINE std::uint32_t bits_of(hn::Mask<Floats> lanes) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Floats(), lanes, bytes);
  return static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8);
}

/// The lanes whose bits are set.
HWY_INLINE hn::Mask<Floats> lanes_of(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(Floats(), bytes);
}

/// A stroke's colour, which is slid under what is drawn already.
struct Paint {
  template <class Stroke>
  explicit Paint(const Stroke& stroke)
      : red(hn::Set(Floats(), stroke.red)),
        green(hn::Set(Floats(), stroke.green)),
        blue(hn::Set(Floats(), stroke.blue)),
        opacity(hn::Set(Floats(), stroke.opacity)) {}

  /// Part of a block, from its column `i` on, as far as it lets light through. Returns which columns still do.
  HWY_INLINE std::uint32_t slide_under(hn::Vec<Floats> cover, FrontToBackAccumulator::Block& block, int i) const {
    const Floats f;
    const auto through = hn::Load(f, block.light + i);
    const auto share = hn::Mul(hn::Mul(cover, opacity), through);
    hn::Store(hn::MulAdd(red, share, hn::Load(f, block.red + i)), f, block.red + i);
    hn::Store(hn::MulAdd(green, share, hn::Load(f, block.green + i)), f, block.green + i);
    hn::Store(hn::MulAdd(blue, share, hn::Load(f, block.blue + i)), f, block.blue + i);
    const auto left = hn::Sub(through, share);
    hn::Store(left, f, block.light + i);
    return bits_of(hn::Gt(left, hn::Set(f, FrontToBackAccumulator::dark))) << i;
  }

  hn::Vec<Floats> red, green, blue, opacity;
};

/// Where a row of a stroke may be seen.
struct RowPart {
  int row, begin, end;              ///< columns
  const HiddenBelow* hidden_below;  ///< may be null
};

/// The columns of a block that are open in the part of a row, a bit each.
HWY_INLINE std::uint32_t open_within(const FrontToBackAccumulator& accumulator, const RowPart& part, int number) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const int first = std::max(part.begin - number * block_px, 0),
            last = std::min(part.end - number * block_px, block_px);
  const std::uint32_t open =
      accumulator.open_columns(part.row, number) & ((std::uint32_t{1} << last) - (std::uint32_t{1} << first));
  if (part.hidden_below == nullptr) return open;
  return open & part.hidden_below->shown_columns[static_cast<std::size_t>(number * accumulator.rows() + part.row)];
}

/// Calls `cover_at(x)` for the vectors of the blocks that are open in the part of a row, and slides the paint under
/// their open columns.
template <class CoverAt>
HWY_INLINE void slide_under_row(const Paint& paint, const RowPart& part, FrontToBackAccumulator& accumulator,
                                CoverAt cover_at) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  for (int number = part.begin / block_px; number * block_px < part.end; ++number) {
    const std::uint32_t within = open_within(accumulator, part, number);
    if (within == 0) continue;
    FrontToBackAccumulator::Block& block = accumulator.block(part.row, number);
    FrontToBackAccumulator::Cover* const most = accumulator.cover(part.row, number);
    std::uint32_t open = 0;
    for (int i = 0; i < block_px; i += lanes) {
      const auto cover = hn::IfThenElseZero(lanes_of(within >> i), cover_at(number * block_px + i));
      if (most != nullptr) hn::StoreU(hn::Max(cover, hn::LoadU(f, most->data() + i)), f, most->data() + i);
      open |= paint.slide_under(cover, block, i);
    }
    accumulator.set_open_columns(part.row, number, open);
  }
}

void draw_under(const StrokeInBand& of, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  const Cover cover(brush);
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
  measure_distances(stroke, below, band);
  const Paint paint(stroke);
  for (int row = band.first_row; row < band.end_row; ++row) {
    const float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    slide_under_row(paint, {row, band.begin[row], band.end[row], nullptr}, accumulator,
                    [&](int x) { return cover.of(hn::LoadU(Floats(), squared + x)); });
  }
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

/// Writes the levels of a row from the value `first` on. Returns where they end; a vector of values after that may be
/// written, too.
std::size_t write_line(const float* squared, const BrushProfile& brush, const ColumnRun& columns, std::size_t first,
                       Stamps& stamps, Stamps::Line& line) {
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto slope = hn::Set(f, -Stamp::steps / brush.rim_px);
  const auto offset = hn::Set(f, Stamp::steps * (brush.middle_px / brush.rim_px + 0.5f) + Stamp::zero + 0.5f);
  const auto least = hn::Zero(f), most = hn::Set(f, Stamp::most), no_cover = hn::Set(f, Stamp::zero + 1);
  std::uint16_t* levels = stamps.values.data() + first;
  std::fill_n(levels, Stamps::margin, std::uint16_t{0});
  levels += Stamps::margin;
  int from = columns.end, to = columns.begin;
  for (int x = columns.begin; x < columns.end; x += lanes) {
    const auto cover = hn::MulAdd(hn::Sqrt(hn::LoadU(f, squared + x)), slope, offset);
    hn::StoreU(hn::DemoteTo(halves, hn::ConvertTo(integers, hn::Min(hn::Max(cover, least), most))), halves,
               levels + (x - columns.begin));
    const std::uint32_t covered = bits_of(hn::Ge(cover, no_cover));
    if (covered == 0) continue;
    from = std::min(from, x + std::countr_zero(covered));
    to = x + 32 - std::countl_zero(covered);
  }
  to = std::min(to, columns.end);
  from = std::min(from, to);
  std::fill_n(levels + (columns.end - columns.begin), Stamps::margin, std::uint16_t{0});
  line = {static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(from - columns.begin), from, to};
  return first + 2 * Stamps::margin + static_cast<std::size_t>(to - columns.begin);
}

void make_stamp(const StrokeInBand& of, int width, std::uint32_t rows, DistanceBand& band, Stamp& stamp,
                Stamps& stamps) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  find_extents(layer, stroke, width, Stamps::aside_px, band);
  for (int row = band.first_row; row < band.end_row; ++row)
    if ((rows >> row & 1) == 0) band.begin[row] = band.end[row] = 0;
  measure_distances(stroke, below, band);
  if (stamp.made == 0) {
    stamp.first_row = band.first_row;
    stamp.end_row = std::max(band.end_row, band.first_row);
    stamp.first_line = static_cast<std::uint32_t>(stamps.lines.size());
    stamps.lines.resize(stamps.lines.size() + static_cast<std::size_t>(stamp.end_row - stamp.first_row));
  }
  stamp.made |= rows;
  std::size_t next = stamps.values.size() - Stamps::slack, most = next + 2 * Stamps::slack;
  for (int row = band.first_row; row < band.end_row; ++row)
    most += 2 * Stamps::margin + static_cast<std::size_t>(std::max(band.end[row] - band.begin[row], 0));
  stamps.values.resize(most);
  for (int row = band.first_row; row < band.end_row; ++row) {
    if (band.begin[row] >= band.end[row]) continue;
    next = write_line(band.squared.data() + static_cast<std::size_t>(row) * band.stride, brush,
                      {band.begin[row], band.end[row]}, next, stamps,
                      stamps.lines[stamp.first_line + static_cast<std::size_t>(row - stamp.first_row)]);
  }
  stamps.values.resize(next + Stamps::slack);
  std::fill(stamps.values.begin() + static_cast<std::ptrdiff_t>(next), stamps.values.end(), std::uint16_t{0});
}

/// The weights of four neighbouring columns for lines that lie a fraction of a pixel farther to the right: those of
/// Catmull-Rom's spline.
struct Fractions {
  static constexpr int bits = 8, count = 1 << bits;

  constexpr Fractions() {
    for (int i = 0; i < count; ++i) {
      const float s = static_cast<float>(i) / count, t = 1 - s, steps = Stamp::steps;
      weights[i][0] = -t * s * s / (2 * steps);
      weights[i][1] = (2 - 5 * t * t + 3 * t * t * t) / (2 * steps);
      weights[i][2] = (2 - 5 * s * s + 3 * s * s * s) / (2 * steps);
      weights[i][3] = -s * t * t / (2 * steps);
    }
  }

  float weights[count][4] = {};
};
constexpr Fractions fractions;

/// The cover that follows from the columns before, at and behind a vector's.
HWY_INLINE hn::Vec<Floats> interpolated(const float* weights, const std::uint16_t* from) {
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  auto level = hn::Set(f, -Stamp::zero / Stamp::steps);
  for (int i = 0; i < 4; ++i)
    level = hn::MulAdd(hn::Set(f, weights[i]), hn::ConvertTo(f, hn::PromoteTo(integers, hn::LoadU(halves, from + i))),
                       level);
  return hn::Min(hn::Max(level, hn::Zero(f)), hn::Set(f, 1.f));
}

/// Where a view sees the rows of a stamp, in fixed point: they lie along a line.
class RowPlaces {
 public:
  explicit RowPlaces(const StampInBand& of) {
    const double unit = 1 << unit_bits, view = of.view;
    const double top = of.paint.disparity + of.paint.depth_slope * (of.band.top + 0.5);
    first_ = static_cast<std::int64_t>((of.stamp.left - view * top) * unit) + (1 << (unit_bits - Fractions::bits - 1));
    step_ = static_cast<std::int64_t>(-view * of.paint.depth_slope * unit);
  }

  void find(int row) { place_ = first_ + row * step_; }
  int whole() const { return static_cast<int>(place_ >> unit_bits); }
  const float* weights() const {
    return fractions.weights[place_ >> (unit_bits - Fractions::bits) & (Fractions::count - 1)];
  }

 private:
  static constexpr int unit_bits = 24;
  std::int64_t first_, step_, place_ = 0;
};

/// `tested`: a surface may hide some of the stamp.
template <bool tested>
void lay_lines_under(const StampInBand& of, FrontToBackAccumulator& accumulator) {
  const Floats f;
  const Paint paint(of.paint);
  const Stamps::Line* lines = of.stamps.lines.data() + of.stamp.first_line;
  RowPlaces places(of);
  for (std::uint32_t rows = of.rows & of.stamp.rows(); rows != 0; rows &= rows - 1) {
    const int row = std::countr_zero(rows);
    const Stamps::Line& line = lines[row - of.stamp.first_row];
    places.find(row);
    const int begin = places.whole() + line.begin;
    const int seen_begin = std::max(begin, 0), seen_end = std::min(places.whole() + line.end + 1, accumulator.width());
    if (line.begin == line.end || seen_begin >= seen_end) continue;
    const std::uint16_t* values = of.stamps.values.data() + line.first_value;
    const float* hidden_below =
        tested ? of.hidden_below.pixels.data() + static_cast<std::size_t>(row) * of.band.stride : nullptr;
    const auto disparity =
        hn::Set(f, of.paint.disparity + of.paint.depth_slope * (static_cast<float>(of.band.top + row) + 0.5f));
    slide_under_row(paint, {row, seen_begin, seen_end, tested ? &of.hidden_below : nullptr}, accumulator, [&](int x) {
      auto cover = interpolated(places.weights(), values + (x - begin));
      if constexpr (tested) cover = hn::IfThenElseZero(hn::Ge(disparity, hn::LoadU(f, hidden_below + x)), cover);
      return cover;
    });
  }
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  if (stamp.tested) {
    lay_lines_under<true>(stamp, accumulator);
  } else {
    lay_lines_under<false>(stamp, accumulator);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(draw_under);
HWY_EXPORT(lay_band_over);
HWY_EXPORT(make_stamp);
HWY_EXPORT(lay_stamp_under);

void draw_stroke_under(const StrokeInBand& stroke, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(draw_under)(stroke, band, accumulator);
}

void lay_over(FrontToBackAccumulator& accumulator, int top, Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(lay_band_over)(accumulator, top, canvas);
}

void make_stamp(const StrokeInBand& stroke, int width, std::uint32_t rows, DistanceBand& band, Stamp& stamp,
                Stamps& stamps) {
  HWY_DYNAMIC_DISPATCH(make_stamp)(stroke, width, rows, band, stamp, stamps);
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(lay_stamp_under)(stamp, accumulator);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
