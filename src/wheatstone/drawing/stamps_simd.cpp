#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/stamps_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wheatstone/drawing/stroke_paint_simd_internal.h"

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Writes the levels of a row from the value `first` on; `level_at(x, value)` gives those of a vector from column x on,
/// which stand from that value on. Returns where they end; a vector of values after that may be written, too.
template <class LevelAt>
HWY_INLINE std::size_t write_line(const ColumnRun& columns, std::size_t first, std::size_t line, LevelAt level_at,
                                  Stamps& stamps) {
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto least = hn::Zero(f), most = hn::Set(f, Stamp::most), no_cover = hn::Set(f, Stamp::zero + 1);
  std::uint16_t* levels = stamps.values.data() + first;
  std::fill_n(levels, Stamps::margin, std::uint16_t{0});
  levels += Stamps::margin;
  int from = columns.end, to = columns.begin;
  for (int x = columns.begin; x < columns.end; x += lanes) {
    const auto cover = level_at(x, first + Stamps::margin + static_cast<std::size_t>(x - columns.begin));
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
  stamps.first_values[line] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(from - columns.begin);
  stamps.begins[line] = from;
  stamps.ends[line] = from < to ? to + 1 : from;
  return first + std::size_t{2} * Stamps::margin + static_cast<std::size_t>(to - columns.begin);
}

/// The share of the colour's change and the tone of some pixels, beside their levels.
HWY_INLINE void store_shades(const Bristles::Paint& paint, std::size_t value, Stamps& stamps) {
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const auto byte = [&](auto level) {
    return hn::DemoteTo(bytes, hn::ConvertTo(integers, hn::Min(hn::Max(level, hn::Zero(f)), hn::Set(f, 255.f))));
  };
  const auto half = hn::Set(f, 0.5f);
  hn::StoreU(byte(hn::MulAdd(paint.share, hn::Set(f, 255.f), half)), bytes, stamps.shares.data() + value);
  hn::StoreU(byte(hn::MulAdd(paint.tone, hn::Set(f, 2.f), hn::Set(f, Stamps::even_tone + 0.5f))), bytes,
             stamps.tones.data() + value);
}

void make_stamp(const StrokeInBand& of, int width, const RowsOfStamp& wanted, DistanceBand& band, Stamp& stamp,
                Stamps& stamps) {
  const auto& [layer, stroke, below, brush] = of;
  find_extents(layer, stroke, width, Stamps::aside_px, band);
  for (int row = band.first_row; row < band.end_row; ++row) {
    if ((wanted.rows >> row & 1) == 0) {
      band.begin[row] = band.end[row] = 0;
    } else if (wanted.columns != nullptr) {
      const ColumnRun& columns = (*wanted.columns)[static_cast<std::size_t>(row)];
      band.begin[row] = std::max(band.begin[row], columns.begin);
      band.end[row] = std::min(band.end[row], columns.end);
    }
  }
  measure_distances(stroke, below, of.varies(), band);
  if (stamp.made == 0) {
    stamp.first_row = band.first_row;
    stamp.end_row = std::max(band.end_row, band.first_row);
    stamp.first_line = stamps.add_lines(static_cast<std::size_t>(stamp.end_row - stamp.first_row));
  }
  stamp.made |= wanted.rows;
  std::size_t next = stamps.values.size() - Stamps::slack, most = next + 2 * Stamps::slack;
  for (int row = band.first_row; row < band.end_row; ++row)
    most += std::size_t{2} * Stamps::margin + static_cast<std::size_t>(std::max(band.end[row] - band.begin[row], 0));
  stamps.values.resize(most);
  if (of.varies()) {
    stamps.shares.resize(most);
    stamps.tones.resize(most, Stamps::even_tone);
  }
  const auto write_lines = [&](auto level_at) {
    for (int row = band.first_row; row < band.end_row; ++row) {
      if (band.begin[row] >= band.end[row]) continue;
      next = write_line(
          {band.begin[row], band.end[row]}, next, stamp.first_line + static_cast<std::size_t>(row - stamp.first_row),
          [&](int x, std::size_t value) { return level_at(row, x, value); }, stamps);
    }
  };
  const Floats f;
  if (of.varies()) {
    const Bristles bristles(stroke, brush);
    write_lines([&](int row, int x, std::size_t value) {
      const Bristles::Paint paint = paint_of_row(bristles, band, row, x);
      store_shades(paint, value, stamps);
      return hn::MulAdd(paint.cover, hn::Set(f, Stamp::steps), hn::Set(f, Stamp::zero + 0.5f));
    });
  } else {
    const BrushProfile profile(stroke.radius_px);
    const auto slope = hn::Set(f, -Stamp::steps / profile.rim_px);
    const auto offset = hn::Set(f, Stamp::steps * (profile.middle_px / profile.rim_px + 0.5f) + Stamp::zero + 0.5f);
    write_lines([&](int row, int x, std::size_t) {
      const float* squared =
          band.squared.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(band.stride);
      return hn::MulAdd(hn::Sqrt(hn::LoadU(f, squared + x)), slope, offset);
    });
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

/// Shares or tones, interpolated between the columns at and before a vector's, in their own steps.
HWY_INLINE hn::Vec<Floats> interpolated(float fraction, const std::uint8_t* from) {
  const Floats f;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const hn::RebindToSigned<Floats> integers;
  const auto at = [&](int i) { return hn::ConvertTo(f, hn::PromoteTo(integers, hn::LoadU(bytes, from + i))); };
  return hn::MulAdd(hn::Set(f, fraction), hn::Sub(at(1), at(2)), at(2));
}

/// A stamp's lines as a view sees them, from its first row on. Their places lie along a line.
struct SeenLines {
  explicit SeenLines(const StampInBand& of)
      : first_row(of.stamp.first_row), count(of.stamp.end_row - of.stamp.first_row) {
    constexpr int unit_bits = 24;  // in fixed point
    constexpr double unit = 1 << unit_bits;
    const double view = of.view, top = of.paint.disparity + of.paint.depth_slope * (of.band.top + 0.5);
    const auto step = static_cast<std::int64_t>(-view * of.paint.depth_slope * unit);
    const std::int64_t first = static_cast<std::int64_t>((of.stamp.left - view * top) * unit) +
                               (1 << (unit_bits - Fractions::bits - 1)) + first_row * step;
    const auto whole = [](std::int64_t place) { return static_cast<std::int32_t>(place >> unit_bits); };
    const auto rest = [](std::int64_t place) { return static_cast<std::int32_t>(place & ((1 << unit_bits) - 1)); };
    const hn::RebindToSigned<Floats> integers;
    const std::uint32_t* first_values = of.stamps.first_values.data() + of.stamp.first_line;
    const std::int32_t* line_begins = of.stamps.begins.data() + of.stamp.first_line;
    const std::int32_t* line_ends = of.stamps.ends.data() + of.stamp.first_line;
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(integers))) {
      const auto steps = hn::Add(hn::Set(integers, i), hn::Iota(integers, 0));
      const auto part = hn::Add(hn::Mul(steps, hn::Set(integers, rest(step))), hn::Set(integers, rest(first)));
      const auto whole_steps = hn::Add(hn::Mul(steps, hn::Set(integers, whole(step))), hn::Set(integers, whole(first)));
      const auto zero = hn::Add(whole_steps, hn::ShiftRight<unit_bits>(part));
      const auto begin = hn::Add(zero, hn::LoadU(integers, line_begins + i));
      const auto value = hn::BitCast(integers, hn::LoadU(hn::RebindToUnsigned<Floats>(), first_values + i));
      hn::StoreU(begin, integers, begins.data() + i);
      hn::StoreU(hn::Add(zero, hn::LoadU(integers, line_ends + i)), integers, ends.data() + i);
      hn::StoreU(hn::Sub(value, begin), integers, levels.data() + i);
      hn::StoreU(hn::And(hn::ShiftRight<unit_bits - Fractions::bits>(part), hn::Set(integers, Fractions::count - 1)),
                 integers, fraction.data() + i);
    }
  }

  static constexpr std::size_t most = band_rows + Canvas::widest_vector;
  int first_row, count;
  std::array<std::int32_t, most> begins, ends;  ///< columns of the picture that the lines cover
  std::array<std::int32_t, most> levels;        ///< of the picture's first column, if it were in the line
  std::array<std::int32_t, most> fraction;      ///< by which the lines lie farther to the right
  std::array<float, most> disparities;          ///< where a surface may hide some
  std::array<std::uint32_t, most> columns;      ///< in a block: those to be drawn, a bit each
};
static_assert(SeenLines::most < 1 << 7);  // rows by parts of a pixel are below 2³¹

/// Rows of a block, a bit each.
struct RowsToDraw {
  std::uint32_t shown = 0, tested = 0;  ///< drawn whole; drawn where no surface hides them
};

/// Finds the columns of a block that a stamp covers, and that are open and shown; `tested`: a surface may hide some.
/// All rows are examined before any is drawn, without a branch for each, because such a branch would be unpredictable.
template <bool tested>
HWY_INLINE RowsToDraw find_columns_to_draw(const StampInBand& of, const FrontToBackAccumulator& accumulator, int number,
                                           SeenLines& seen) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const hn::RebindToUnsigned<Floats> words;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const std::uint16_t* open = accumulator.open_columns_from(seen.first_row, number);
  const std::size_t first_of_block = place_in_blocks(seen.first_row, number, accumulator.rows());
  const std::uint16_t* shown = tested ? of.hidden_below.shown_columns.data() + first_of_block : nullptr;
  const float* most_hidden = tested ? of.hidden_below.most_of_rows.data() + first_of_block : nullptr;
  const auto left = hn::Set(integers, number * block_px);
  const auto in_block = [&](auto column) {
    return hn::BitCast(words, hn::Min(hn::Max(column, hn::Zero(integers)), hn::Set(integers, block_px)));
  };
  std::uint32_t rows = 0, hidden = 0;
  for (int i = 0; i < seen.count; i += static_cast<int>(hn::Lanes(f))) {
    const auto begin = in_block(hn::Sub(hn::LoadU(integers, seen.begins.data() + i), left));
    const auto end = in_block(hn::Sub(hn::LoadU(integers, seen.ends.data() + i), left));
    const auto one = hn::Set(words, 1u);
    auto columns =
        hn::And(hn::Sub(hn::Shl(one, end), hn::Shl(one, begin)), hn::PromoteTo(words, hn::LoadU(halves, open + i)));
    if constexpr (tested) {
      columns = hn::And(columns, hn::PromoteTo(words, hn::LoadU(halves, shown + i)));
      const auto disparity = hn::LoadU(f, seen.disparities.data() + i);
      hidden |= bits_of(hn::Lt(disparity, hn::LoadU(f, most_hidden + i))) << i;
    }
    hn::StoreU(columns, words, seen.columns.data() + i);
    rows |= bits_of(hn::RebindMask(f, hn::Ne(columns, hn::Zero(words)))) << i;
  }
  return {(rows & ~hidden) << seen.first_row, (rows & hidden) << seen.first_row};
}

/// Composites the visible part of some rows of a block under what is drawn already. `tested`: only where no surface
/// hides it.
template <bool tested, bool varies>
HWY_INLINE void lay_rows_under(const StampInBand& of, const SeenLines& seen, int number, std::uint32_t rows,
                               FrontToBackAccumulator& accumulator) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const std::ptrdiff_t first_column = std::ptrdiff_t{number} * block_px;
  const Floats f;
  const Paint<varies> paint(of.paint);
  const std::uint16_t* levels = of.stamps.values.data() + first_column;
  const float* hidden_below = tested ? of.hidden_below.pixels.data() + first_column : nullptr;
  const std::ptrdiff_t stride = of.band.stride;
  FrontToBackAccumulator::Block* blocks = &accumulator.block(0, number);
  std::uint16_t* open_columns = accumulator.open_columns_of(number);
  std::uint32_t closed = 0;
  for (std::uint32_t left = rows; left != 0; left &= left - 1) {
    const int row = std::countr_zero(left), i = row - seen.first_row;
    const std::uint16_t* from = levels + seen.levels[i];
    const float* weights = fractions.weights[seen.fraction[i]];
    std::uint32_t open = 0;
    for (int x = 0; x < block_px; x += static_cast<int>(hn::Lanes(f))) {
      auto cover = interpolated(weights, from + x);
      if constexpr (tested) {
        const auto disparity = hn::Set(f, seen.disparities[i]);
        cover = hn::IfThenElseZero(hn::Ge(disparity, hn::LoadU(f, hidden_below + row * stride + x)), cover);
      }
      cover = hn::IfThenElseZero(lanes_of(seen.columns[i] >> x), cover);
      PaintHere here{cover, cover, cover};
      if constexpr (varies) {
        const std::ptrdiff_t value = first_column + seen.levels[i] + x;
        const float fraction = static_cast<float>(seen.fraction[i]) / Fractions::count;
        here.share = hn::Mul(interpolated(fraction, of.stamps.shares.data() + value), hn::Set(f, 1.f / 255));
        here.tone = hn::MulAdd(interpolated(fraction, of.stamps.tones.data() + value), hn::Set(f, 0.5f),
                               hn::Set(f, -0.5f * Stamps::even_tone));
      }
      open |= paint.slide_under(here, blocks[row], x);
    }
    open_columns[row] = static_cast<std::uint16_t>(open);
    closed |= (open == 0 ? std::uint32_t{1} : std::uint32_t{0}) << row;
  }
  accumulator.note_rows(number, rows, closed);
}

/// `tested`: a surface may hide some of the stamp.
template <bool tested, bool varies>
void lay_lines_under(const StampInBand& of, FrontToBackAccumulator& accumulator) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const Floats f;
  SeenLines seen(of);
  if constexpr (tested) {
    const auto middle = static_cast<float>(of.band.top + seen.first_row) + 0.5f;
    for (int i = 0; i < seen.count; i += static_cast<int>(hn::Lanes(f)))
      hn::StoreU(hn::MulAdd(hn::Set(f, of.paint.depth_slope),
                            hn::Add(hn::Set(f, static_cast<float>(i) + middle), hn::Iota(f, 0)),
                            hn::Set(f, of.paint.disparity)),
                 f, seen.disparities.data() + i);
  }
  const std::uint32_t stamped = of.rows & of.stamp.rows();
  for (int number = of.columns.begin / block_px; number * block_px < of.columns.end; ++number) {
    if ((stamped & accumulator.open_rows(number)) == 0) continue;
    const RowsToDraw rows = find_columns_to_draw<tested>(of, accumulator, number, seen);
    lay_rows_under<false, varies>(of, seen, number, rows.shown & stamped, accumulator);
    if constexpr (tested) lay_rows_under<true, varies>(of, seen, number, rows.tested & stamped, accumulator);
  }
}

std::uint32_t find_rows_to_draw(std::uint32_t rows, const ColumnRun& columns, const HiddenBelow& below,
                                const FrontToBackAccumulator& accumulator) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const hn::CappedTag<std::uint16_t, 16> words;
  const bool all_shown = below.shown_columns.empty();
  std::uint32_t found = 0;
  for (int number = columns.begin / block_px; number * block_px < columns.end; ++number) {
    std::uint32_t candidates = rows & accumulator.open_rows(number) & ~found;
    if (!all_shown) candidates &= below.blocks[static_cast<std::size_t>(number)].shown_rows;
    if (candidates == 0) continue;
    const auto below_column = [=](int column) {
      return (std::uint32_t{1} << std::clamp(column - number * block_px, 0, block_px)) - 1;
    };
    const auto within =
        hn::Set(words, static_cast<std::uint16_t>(below_column(columns.end) & ~below_column(columns.begin)));
    const std::uint16_t* open = accumulator.open_columns_from(0, number);
    const std::uint16_t* shown =
        all_shown ? nullptr : &below.shown_columns[place_in_blocks(0, number, accumulator.rows())];
    std::uint32_t any = 0;
    for (int row = 0; row < accumulator.rows(); row += static_cast<int>(hn::Lanes(words))) {
      auto left = hn::And(hn::LoadU(words, open + row), within);
      if (!all_shown) left = hn::And(left, hn::LoadU(words, shown + row));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(words, hn::Ne(left, hn::Zero(words)), bytes);
      any |= static_cast<std::uint32_t>(bytes[0] | bytes[1] << 8) << row;
    }
    found |= candidates & any;
  }
  return found;
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  if (stamp.varies) {
    stamp.tested ? lay_lines_under<true, true>(stamp, accumulator) : lay_lines_under<false, true>(stamp, accumulator);
  } else {
    stamp.tested ? lay_lines_under<true, false>(stamp, accumulator) : lay_lines_under<false, false>(stamp, accumulator);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(make_stamp);
HWY_EXPORT(find_rows_to_draw);
HWY_EXPORT(lay_stamp_under);

void make_stamp(const StrokeInBand& stroke, int width, const RowsOfStamp& wanted, DistanceBand& band, Stamp& stamp,
                Stamps& stamps) {
  HWY_DYNAMIC_DISPATCH(make_stamp)(stroke, width, wanted, band, stamp, stamps);
}

std::uint32_t rows_to_draw(std::uint32_t rows, const ColumnRun& columns, const HiddenBelow& below,
                           const FrontToBackAccumulator& accumulator) {
  return HWY_DYNAMIC_DISPATCH(find_rows_to_draw)(rows, columns, below, accumulator);
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(lay_stamp_under)(stamp, accumulator);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
