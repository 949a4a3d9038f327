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
    if (stroke.farthest_disparity < below.blocks[static_cast<std::size_t>(block)]) return true;
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

/// Slides the stroke's colour under one row of what is drawn already, as far as that lets light through.
void slide_under_row(const FlatStroke& stroke, const Cover& cover, const DistanceBand& band, int row,
                     FrontToBackAccumulator& accumulator) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
  const std::size_t offset = static_cast<std::size_t>(row) * accumulator.stride;
  float* red = accumulator.red.data() + offset;
  float* green = accumulator.green.data() + offset;
  float* blue = accumulator.blue.data() + offset;
  float* light = accumulator.light.data() + offset;
  const auto opacity = hn::Set(f, stroke.opacity);
  const auto stroke_red = hn::Set(f, stroke.red);
  const auto stroke_green = hn::Set(f, stroke.green);
  const auto stroke_blue = hn::Set(f, stroke.blue);
  for (int x = band.begin[row]; x < band.end[row]; x += lanes) {
    const auto distance = hn::LoadU(f, squared + x);
    if (cover.is_zero(distance)) continue;
    const auto alpha = hn::Mul(cover.of(distance), opacity);
    const auto through = hn::LoadU(f, light + x);
    const auto share = hn::Mul(alpha, through);
    const auto lay = [&](float* plane, auto colour) {
      hn::StoreU(hn::MulAdd(colour, share, hn::LoadU(f, plane + x)), f, plane + x);
    };
    lay(red, stroke_red);
    lay(green, stroke_green);
    lay(blue, stroke_blue);
    hn::StoreU(hn::Sub(through, share), f, light + x);
  }
}

/// Notes which blocks of some columns of a row still let light through.
void close_dark_blocks(int row, int begin, int columns_end, FrontToBackAccumulator& accumulator) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float* light = accumulator.light.data() + static_cast<std::size_t>(row) * accumulator.stride;
  const auto dark = hn::Set(f, FrontToBackAccumulator::dark);
  for (int block = begin / FrontToBackAccumulator::block_px; block * FrontToBackAccumulator::block_px < columns_end;
       ++block) {
    const int end = (block + 1) * FrontToBackAccumulator::block_px;
    bool is_open = false;
    for (int x = block * FrontToBackAccumulator::block_px; x < end; x += lanes)
      is_open = is_open || !hn::AllFalse(f, hn::Gt(hn::LoadU(f, light + x), dark));
    if (!is_open) accumulator.open.close(row, block);
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
  find_extents(layer, stroke, brush.reach_px, accumulator.width, band);
  bool is_seen = false;
  for (int row = band.first_row; row < band.end_row; ++row) {
    if (band.begin[row] >= band.end[row]) continue;
    accumulator.open.clamp(row, band.begin[row], band.end[row]);
    is_seen = is_seen || band.begin[row] < band.end[row];
  }
  if (!is_seen) return;
  measure_distances(of, band);
  for (int row = band.first_row; row < band.end_row; ++row) {
    if (band.begin[row] >= band.end[row]) continue;
    slide_under_row(stroke, cover, band, row, accumulator);
    close_dark_blocks(row, band.begin[row], band.end[row], accumulator);
  }
}

void make_stamp(const StrokeInBand& of, DistanceBand& band, Stamp& stamp, std::vector<std::uint16_t>& values) {
  const auto& [layer, stroke, below] = of;
  const BrushProfile brush(stroke.radius_px);
  find_extents(layer, stroke, brush.reach_px, stamp.width, band);
  measure_distances(of, band);
  stamp.first_row = band.first_row;
  stamp.end_row = std::max(band.end_row, band.first_row);
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto slope = hn::Set(f, -Stamp::steps / brush.rim_px);
  const auto offset = hn::Set(f, Stamp::steps * (brush.middle_px / brush.rim_px + 0.5f) + Stamp::zero + 0.5f);
  const auto least = hn::Zero(f), most = hn::Set(f, Stamp::most);
  // Rows follow each other with columns without cover between them; vectors are written and read beyond their ends.
  stamp.first_value = values.size() - std::min<std::size_t>(values.size(), Stamp::slack);
  values.resize(stamp.first_value + static_cast<std::size_t>(stamp.end_row - stamp.first_row) * stamp.stride() +
                Stamp::slack);
  for (int row = stamp.first_row; row < stamp.end_row; ++row) {
    const float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    std::uint16_t* to =
        values.data() + stamp.first_value + static_cast<std::size_t>(row - stamp.first_row) * stamp.stride();
    std::fill_n(to, stamp.stride(), std::uint16_t{0});
    for (int x = band.begin[row]; x < band.end[row]; x += lanes) {
      const auto cover = hn::MulAdd(hn::Sqrt(hn::LoadU(f, squared + x)), slope, offset);
      const auto rounded = hn::ConvertTo(integers, hn::Min(hn::Max(cover, least), most));
      hn::StoreU(hn::DemoteTo(halves, rounded), halves, to + Stamp::margin + x);
    }
    for (int x = std::min(std::max(band.begin[row], band.end[row]), stamp.width); x < stamp.width + lanes; ++x)
      to[Stamp::margin + x] = 0;
  }
}

/// One row of a stamp as a view sees it.
struct StampRow {
  const std::uint16_t* values;  ///< of its row, the columns without cover before its first included
  int left;                     ///< column at which the first lies, rounded down
  int begin, end;               ///< columns that it covers
  float fraction;               ///< by which it lies farther to the right
  float disparity;
};

/// Slides a row of a stamp under what is drawn already. `tested`: a surface may hide some of it.
template <bool tested>
void slide_stamp_under_row(const StampInBand& of, const StampRow& stamp, int row, FrontToBackAccumulator& accumulator) {
  const Floats f;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const std::size_t offset = static_cast<std::size_t>(row) * accumulator.stride;
  float* red = accumulator.red.data() + offset;
  float* green = accumulator.green.data() + offset;
  float* blue = accumulator.blue.data() + offset;
  float* light = accumulator.light.data() + offset;
  const FlatStroke& stroke = of.stroke;
  // Catmull-Rom's spline through four columns.
  const float t = 1 - stamp.fraction, s = stamp.fraction;
  const auto first_share = hn::Set(f, -t * s * s / 2), second_share = hn::Set(f, (2 - 5 * t * t + 3 * t * t * t) / 2),
             third_share = hn::Set(f, (2 - 5 * s * s + 3 * s * s * s) / 2), fourth_share = hn::Set(f, -s * t * t / 2);
  const auto scale = hn::Set(f, 1 / Stamp::steps), zero_level = hn::Set(f, -Stamp::zero / Stamp::steps);
  for (int x = stamp.begin; x < stamp.end; x += lanes) {
    const std::uint16_t* from = stamp.values + (x - stamp.left);
    const auto column = [&](int i) { return hn::ConvertTo(f, hn::PromoteTo(integers, hn::LoadU(halves, from + i))); };
    auto level = hn::Mul(first_share, column(0));
    level = hn::MulAdd(second_share, column(1), level);
    level = hn::MulAdd(third_share, column(2), level);
    level = hn::MulAdd(fourth_share, column(3), level);
    auto cover = hn::Min(hn::Max(hn::MulAdd(level, scale, zero_level), hn::Zero(f)), hn::Set(f, 1.f));
    cover = hn::IfThenElseZero(hn::FirstN(f, static_cast<std::size_t>(std::min(stamp.end - x, lanes))), cover);
    if constexpr (tested) {
      const auto least = hn::LoadU(f, of.hidden_below.pixels.data() + offset + x);
      cover = hn::IfThenElseZero(hn::Ge(hn::Set(f, stamp.disparity), least), cover);
    }
    const auto through = hn::LoadU(f, light + x);
    const auto share = hn::Mul(hn::Mul(cover, hn::Set(f, stroke.opacity)), through);
    hn::StoreU(hn::MulAdd(hn::Set(f, stroke.red), share, hn::LoadU(f, red + x)), f, red + x);
    hn::StoreU(hn::MulAdd(hn::Set(f, stroke.green), share, hn::LoadU(f, green + x)), f, green + x);
    hn::StoreU(hn::MulAdd(hn::Set(f, stroke.blue), share, hn::LoadU(f, blue + x)), f, blue + x);
    const auto left = hn::Sub(through, share);
    hn::StoreU(left, f, light + x);
    // A block can only have become dark where this part of it has.
    const auto is_light = hn::Gt(left, hn::Set(f, FrontToBackAccumulator::dark));
    if (hn::AllFalse(f, is_light)) close_dark_blocks(row, x, std::min(x + lanes, accumulator.width), accumulator);
  }
}

void lay_stamp_under(const StampInBand& of, FrontToBackAccumulator& accumulator) {
  const auto& [stamp, values, stroke, below, view, top, tested] = of;
  constexpr int block_px = FrontToBackAccumulator::block_px;
  for (int row = stamp.first_row; row < stamp.end_row; ++row) {
    const float disparity = stroke.disparity + stroke.depth_slope * (static_cast<float>(top + row) + 0.5f);
    const float left = static_cast<float>(stamp.left) - view * disparity;
    const float whole = std::floor(left);
    const int first = static_cast<int>(whole);
    const int begin = std::max(first, 0), end = std::min(first + stamp.width + 1, accumulator.width);
    if (begin >= end || !accumulator.open.is_any_open(row, begin / block_px, (end - 1) / block_px)) continue;
    const StampRow stamp_row{values + static_cast<std::size_t>(row - stamp.first_row) * stamp.stride(),
                             first,
                             begin,
                             end,
                             left - whole,
                             disparity};
    if (tested) {
      slide_stamp_under_row<true>(of, stamp_row, row, accumulator);
    } else {
      slide_stamp_under_row<false>(of, stamp_row, row, accumulator);
    }
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

void make_stamp(const StrokeInBand& stroke, DistanceBand& band, Stamp& stamp, std::vector<std::uint16_t>& values) {
  HWY_DYNAMIC_DISPATCH(make_stamp)(stroke, band, stamp, values);
}

void lay_stamp_under(const StampInBand& stamp, FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(lay_stamp_under)(stamp, accumulator);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
