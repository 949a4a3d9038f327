#include <algorithm>
#include <cmath>
#include <type_traits>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/rasterise_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;
constexpr float far_away = 1e30f;

struct Segment {
  float x, y;    // where it begins
  float dx, dy;  // from there to its end
  float disparity, disparity_step;
};

SegmentBox box_of(const Segment& segment, float reach, int canvas_width, const DistanceBand& band) {
  const float left = std::min(segment.x, segment.x + segment.dx) - reach;
  const float right = std::max(segment.x, segment.x + segment.dx) + reach;
  const float top = std::min(segment.y, segment.y + segment.dy) - reach;
  const float bottom = std::max(segment.y, segment.y + segment.dy) + reach;
  // Truncation is floor where it matters: what is negative is clamped to 0 anyway.
  const auto band_top = static_cast<float>(band.top);
  return {std::max(static_cast<int>(top - band_top), 0),
          std::min(static_cast<int>(bottom - band_top + 1), band.row_count), std::max(static_cast<int>(left), 0),
          std::min(static_cast<int>(right + 1), canvas_width)};
}

/// Calls `visit` with each segment of a stroke; a dot is one segment of no length.
template <class Visit>
void for_each_segment(const SeenLayer& layer, const FlatStroke& stroke, Visit visit) {
  const std::size_t first = stroke.first_vertex;
  const float* y = layer.flat.y.data() + first;
  const float* d = layer.flat.disparity.data() + first;
  float x = layer.x(first);
  if (stroke.vertex_count == 1) visit(Segment{x, y[0], 0, 0, d[0], 0});
  for (std::uint32_t i = 1; i < stroke.vertex_count; ++i) {
    const float next = layer.x(first + i);
    visit(Segment{x, y[i - 1], next - x, y[i] - y[i - 1], d[i - 1], d[i] - d[i - 1]});
    x = next;
  }
}

/// Notes the rows and columns of the band that the stroke touches.
void find_extents(const SeenLayer& layer, const FlatStroke& stroke, float reach, int canvas_width, DistanceBand& band) {
  const auto band_top = static_cast<float>(band.top);
  band.first_row = std::max(static_cast<int>(stroke.top - reach - band_top), 0);
  band.end_row = std::min(static_cast<int>(stroke.bottom + reach - band_top + 1), band.row_count);
  for (int row = band.first_row; row < band.end_row; ++row) {
    band.begin[row] = canvas_width;
    band.end[row] = 0;
  }
  band.boxes.clear();
  for_each_segment(layer, stroke, [&](const Segment& segment) {
    const SegmentBox box = box_of(segment, reach, canvas_width, band);
    band.boxes.push_back(box);
    for (int row = box.first_row; row < box.end_row; ++row) {
      band.begin[row] = std::min(band.begin[row], box.begin);
      band.end[row] = std::max(band.end[row], box.end);
    }
  });
}

/// Lowers the band's distances to those of one segment, over the pixels that the brush touches; `tested`: but for those
/// where a surface hides it.
template <bool tested>
void lower_to_segment(const Segment& segment, const SegmentBox& box, const HiddenBelow& below, DistanceBand& band) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float squared_length = segment.dx * segment.dx + segment.dy * segment.dy;
  const float inverse = squared_length > 0 ? 1 / squared_length : 0;
  const auto dx = hn::Set(f, segment.dx), dy = hn::Set(f, segment.dy);
  const auto disparity = hn::Set(f, segment.disparity), disparity_step = hn::Set(f, segment.disparity_step);
  const auto along_x = hn::Set(f, segment.dx * inverse);
  const auto zero = hn::Zero(f), one = hn::Set(f, 1.f), far = hn::Set(f, far_away);
  const auto step = hn::Set(f, static_cast<float>(lanes));
  const auto first_x = hn::Iota(f, 0.5f - segment.x);
  for (int row = box.first_row; row < box.end_row; ++row) {
    const int begin = std::max(box.begin, band.begin[row]), end = std::min(box.end, band.end[row]);
    const float pixel_y = static_cast<float>(band.top + row) + 0.5f - segment.y;
    const auto py = hn::Set(f, pixel_y);
    const auto along_y = hn::Set(f, pixel_y * segment.dy * inverse);
    const std::size_t offset = static_cast<std::size_t>(row) * band.stride;
    float* squared = band.squared.data() + offset;
    const float* hidden_below = tested ? below.pixels.data() + offset : nullptr;
    auto px = hn::Add(first_x, hn::Set(f, static_cast<float>(begin)));
    for (int x = begin; x < end; x += lanes) {
      const auto t = hn::Min(hn::Max(hn::MulAdd(px, along_x, along_y), zero), one);
      const auto ex = hn::NegMulAdd(t, dx, px);
      const auto ey = hn::NegMulAdd(t, dy, py);
      auto distance = hn::MulAdd(ex, ex, hn::Mul(ey, ey));
      if constexpr (tested) {
        const auto is_hidden = hn::Lt(hn::MulAdd(t, disparity_step, disparity), hn::LoadU(f, hidden_below + x));
        distance = hn::IfThenElse(is_hidden, far, distance);
      }
      hn::StoreU(hn::Min(hn::LoadU(f, squared + x), distance), f, squared + x);
      px = hn::Add(px, step);
    }
  }
}

/// Whether a surface of the band may hide some of a stroke.
bool may_be_hidden(const FlatStroke& stroke, const HiddenBelow& below, const DistanceBand& band) {
  if (below.pixels.empty() || band.first_row >= band.end_row) return false;
  int begin = band.stride, end = 0;
  for (const SegmentBox& box : band.boxes) {
    begin = std::min(begin, box.begin);
    end = std::max(end, box.end);
  }
  for (int block = begin / HiddenBelow::block_px; block * HiddenBelow::block_px < end; ++block)
    if (stroke.farthest_disparity < below.most[static_cast<std::size_t>(block)]) return true;
  return false;
}

/// Fills the band with the stroke's squared distances, within its extents.
void measure_distances(const StrokeInBand& of, DistanceBand& band) {
  const SeenLayer& layer = of.layer;
  const FlatStroke& stroke = of.stroke;
  const HiddenBelow& below = of.hidden_below;
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto far = hn::Set(f, far_away);
  for (int row = band.first_row; row < band.end_row; ++row) {
    float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    for (int x = band.begin[row]; x < band.end[row]; x += lanes) hn::StoreU(far, f, squared + x);
  }
  const SegmentBox* box = band.boxes.data();
  const auto lower = [&]<bool tested>(std::bool_constant<tested>) {
    for_each_segment(layer, stroke,
                     [&](const Segment& segment) { lower_to_segment<tested>(segment, *box++, below, band); });
  };
  if (may_be_hidden(stroke, below, band)) {
    lower(std::true_type());
  } else {
    lower(std::false_type());
  }
}

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

/// Lays the stroke's colour over one row of the canvas, as far as its distances say.
void lay_over_row(const FlatStroke& stroke, const Cover& cover, const DistanceBand& band, int row, Canvas& canvas) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const int y = band.top + row;
  const float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
  float* red = canvas.red.row(y).data();
  float* green = canvas.green.row(y).data();
  float* blue = canvas.blue.row(y).data();
  float* coverage = canvas.coverage.row(y).data();
  const auto opacity = hn::Set(f, stroke.opacity);
  const auto stroke_red = hn::Set(f, stroke.red);
  const auto stroke_green = hn::Set(f, stroke.green);
  const auto stroke_blue = hn::Set(f, stroke.blue);
  for (int x = band.begin[row]; x < band.end[row]; x += lanes) {
    const auto distance = hn::LoadU(f, squared + x);
    if (cover.is_zero(distance)) continue;
    const auto covered = cover.of(distance);
    const auto alpha = hn::Mul(covered, opacity);
    const auto lay = [&](float* plane, auto colour) {
      const auto old = hn::LoadU(f, plane + x);
      hn::StoreU(hn::MulAdd(hn::Sub(colour, old), alpha, old), f, plane + x);
    };
    lay(red, stroke_red);
    lay(green, stroke_green);
    lay(blue, stroke_blue);
    hn::StoreU(hn::Max(hn::LoadU(f, coverage + x), covered), f, coverage + x);
  }
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
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(f, hn::Gt(left, hn::Set(f, FrontToBackAccumulator::dark)), bits);
    return static_cast<std::uint32_t>(bits[0] | bits[1] << 8) << i;
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

HWY_INLINE bool is_any_open(const FrontToBackAccumulator& accumulator, const RowPart& part) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  for (int number = part.begin / block_px; number * block_px < part.end; ++number)
    if (open_within(accumulator, part, number) != 0) return true;
  return false;
}

/// Calls `cover_at(x)` for the vectors of the blocks that are open in the part of a row, and slides the paint under
/// them.
template <class CoverAt>
HWY_INLINE void slide_under_row(const Paint& paint, const RowPart& part, FrontToBackAccumulator& accumulator,
                                CoverAt cover_at) {
  constexpr int block_px = FrontToBackAccumulator::block_px;
  const int lanes = static_cast<int>(hn::Lanes(Floats()));
  for (int number = part.begin / block_px; number * block_px < part.end; ++number) {
    if (open_within(accumulator, part, number) == 0) continue;
    FrontToBackAccumulator::Block& block = accumulator.block(part.row, number);
    std::uint32_t open = 0;
    for (int i = 0; i < block_px; i += lanes) open |= paint.slide_under(cover_at(number * block_px + i), block, i);
    accumulator.set_open_columns(part.row, number, open);
  }
}

void draw_over(const StrokeInBand& of, DistanceBand& band, Canvas& canvas) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  const Cover cover(brush);
  find_extents(layer, stroke, brush.reach_px, canvas.width, band);
  measure_distances(of, band);
  for (int row = band.first_row; row < band.end_row; ++row) lay_over_row(stroke, cover, band, row, canvas);
}

void draw_under(const StrokeInBand& of, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  const Cover cover(brush);
  find_extents(layer, stroke, brush.reach_px, accumulator.width(), band);
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
  measure_distances(of, band);
  const Paint paint(stroke);
  for (int row = band.first_row; row < band.end_row; ++row) {
    const float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    slide_under_row(paint, {row, band.begin[row], band.end[row], nullptr}, accumulator,
                    [&](int x) { return cover.of(hn::LoadU(Floats(), squared + x)); });
  }
}

/// Appends the levels of the columns [begin, end) of a row, but for those at its ends that are far from all cover.
void add_line(const float* squared, const BrushProfile& brush, int begin, int end, Stamps& stamps) {
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto slope = hn::Set(f, -Stamp::steps / brush.rim_px);
  const auto offset = hn::Set(f, Stamp::steps * (brush.middle_px / brush.rim_px + 0.5f) + Stamp::zero + 0.5f);
  const auto least = hn::Zero(f), most = hn::Set(f, Stamp::most);
  // Lines are written in vectors, beyond their ends.
  const std::size_t first = stamps.values.size() - Stamps::slack;
  stamps.values.resize(first + Stamps::margin + static_cast<std::size_t>(std::max(end - begin, 0)) + Stamps::slack +
                       Stamps::margin);
  std::uint16_t* levels = stamps.values.data() + first + Stamps::margin;
  for (int x = begin; x < end; x += lanes) {
    const auto cover = hn::MulAdd(hn::Sqrt(hn::LoadU(f, squared + x)), slope, offset);
    const auto rounded = hn::ConvertTo(integers, hn::Min(hn::Max(cover, least), most));
    hn::StoreU(hn::DemoteTo(halves, rounded), halves, levels + (x - begin));
  }
  int from = 0, to = std::max(end - begin, 0);
  while (from < to && levels[from] == 0) ++from;
  while (to > from && levels[to - 1] == 0) --to;
  std::copy(levels + from, levels + to, levels);
  const auto length = static_cast<std::size_t>(to - from);
  std::fill(levels + length, stamps.values.data() + stamps.values.size(), std::uint16_t{0});
  stamps.lines.push_back({static_cast<std::uint32_t>(first), begin + from, begin + to});
  stamps.values.resize(first + Stamps::margin + length + Stamps::slack);
}

void make_stamp(const StrokeInBand& of, int width, DistanceBand& band, Stamp& stamp, Stamps& stamps) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  find_extents(layer, stroke, brush.reach_px, width, band);
  measure_distances(of, band);
  stamp.first_row = band.first_row;
  stamp.end_row = std::max(band.end_row, band.first_row);
  stamp.first_line = static_cast<std::uint32_t>(stamps.lines.size());
  stamp.is_made = true;
  for (int row = stamp.first_row; row < stamp.end_row; ++row)
    add_line(band.squared.data() + static_cast<std::size_t>(row) * band.stride, brush, band.begin[row], band.end[row],
             stamps);
}

/// By how much of a pixel a line lies farther to the right: the weights of four neighbouring columns, those of
/// Catmull-Rom's spline.
struct Fraction {
  explicit Fraction(float s) {
    const Floats f;
    const float t = 1 - s, steps = Stamp::steps;
    first = hn::Set(f, -t * s * s / (2 * steps));
    second = hn::Set(f, (2 - 5 * t * t + 3 * t * t * t) / (2 * steps));
    third = hn::Set(f, (2 - 5 * s * s + 3 * s * s * s) / (2 * steps));
    fourth = hn::Set(f, -s * t * t / (2 * steps));
  }

  /// The cover that follows from the columns before, at and behind a vector's.
  HWY_INLINE hn::Vec<Floats> cover(const std::uint16_t* from) const {
    const Floats f;
    const hn::Rebind<std::uint16_t, Floats> halves;
    const hn::RebindToSigned<Floats> integers;
    const auto column = [&](int i) { return hn::ConvertTo(f, hn::PromoteTo(integers, hn::LoadU(halves, from + i))); };
    auto level = hn::MulAdd(first, column(0), hn::Set(f, -Stamp::zero / Stamp::steps));
    level = hn::MulAdd(second, column(1), level);
    level = hn::MulAdd(third, column(2), level);
    level = hn::MulAdd(fourth, column(3), level);
    return hn::Min(hn::Max(level, hn::Zero(f)), hn::Set(f, 1.f));
  }

  hn::Vec<Floats> first, second, third, fourth;
};

/// The lanes of a vector at x that lie in the columns [begin, end).
HWY_INLINE hn::Mask<Floats> lanes_within(int x, int begin, int end) {
  const Floats f;
  const auto lanes = static_cast<int>(hn::Lanes(f));
  const auto until = [&](int column) {
    return hn::FirstN(f, static_cast<std::size_t>(std::clamp(column - x, 0, lanes)));
  };
  return hn::AndNot(until(begin), until(end));
}

/// `tested`: a surface may hide some of the stamp.
template <bool tested>
void lay_lines_under(const StampInBand& of, FrontToBackAccumulator& accumulator) {
  const Floats f;
  const Paint paint(of.paint);
  const Stamps::Line* line = of.stamps.lines.data() + of.stamp.first_line;
  for (int row = of.stamp.first_row; row < of.stamp.end_row; ++row, ++line) {
    if ((of.rows >> row & 1) == 0 || line->begin >= line->end) continue;
    const float disparity = of.paint.disparity + of.paint.depth_slope * (static_cast<float>(of.band.top + row) + 0.5f);
    const float left = of.stamp.left - of.view * disparity;
    const float whole = std::floor(left);
    const int begin = static_cast<int>(whole) + line->begin, end = static_cast<int>(whole) + line->end + 1;
    const int seen_begin = std::max(begin, 0), seen_end = std::min(end, accumulator.width());
    const RowPart part{row, seen_begin, seen_end, tested ? &of.hidden_below : nullptr};
    if (seen_begin >= seen_end || !is_any_open(accumulator, part)) continue;
    const Fraction fraction(left - whole);
    const std::uint16_t* values = of.stamps.values.data() + line->first_value;
    const float* hidden_below =
        tested ? of.hidden_below.pixels.data() + static_cast<std::size_t>(row) * of.band.stride : nullptr;
    slide_under_row(paint, part, accumulator, [&](int x) {
      auto cover = hn::IfThenElseZero(lanes_within(x, begin, end), fraction.cover(values + (x - begin)));
      if constexpr (tested)
        cover = hn::IfThenElseZero(hn::Ge(hn::Set(f, disparity), hn::LoadU(f, hidden_below + x)), cover);
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

HWY_EXPORT(draw_over);
HWY_EXPORT(draw_under);
HWY_EXPORT(make_stamp);
HWY_EXPORT(lay_stamp_under);

void draw_stroke_over(const StrokeInBand& stroke, DistanceBand& band, Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(draw_over)(stroke, band, canvas);
}

void draw_stroke_under(const StrokeInBand& stroke, DistanceBand& band, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(draw_under)(stroke, band, accumulator);
}

void make_stamp(const StrokeInBand& stroke, int width, DistanceBand& band, Stamp& stamp, Stamps& stamps) {
  HWY_DYNAMIC_DISPATCH(make_stamp)(stroke, width, band, stamp, stamps);
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(lay_stamp_under)(stamp, accumulator);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
