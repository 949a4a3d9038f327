#include <algorithm>

#include "wheatstone/drawing/rasterise_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/drawing/distances_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, Canvas::widest_vector>;
constexpr float far_away = 1e30f;

/// `first`, and one more in each lane after it. Highway's Iota writes each lane to memory unless it begins with a
/// constant.
template <class Tag>
HWY_INLINE hn::Vec<Tag> counted_from(Tag tag, hn::TFromD<Tag> first) {
  return hn::Add(hn::Set(tag, first), hn::Iota(tag, 0));
}

/// Where the segments of a stroke lie.
void place_chain(const SeenLayer& layer, const FlatStroke& stroke, int band_top, Chain& chain) {
  const Floats f;
  const std::size_t lanes = hn::Lanes(f);
  const std::size_t segments = std::max(stroke.vertex_count, 2u) - 1;
  const float* x = layer.flat.x.data() + stroke.first_vertex;
  const float* y = layer.flat.y.data() + stroke.first_vertex;
  const float* d = layer.flat.disparity.data() + stroke.first_vertex;
  const auto shift = hn::Set(f, layer.shift), left = hn::Set(f, layer.left_px);
  const auto top = hn::Set(f, static_cast<float>(band_top));
  const auto zero = hn::Zero(f), one = hn::Set(f, 1.f);
  const bool is_dot = stroke.vertex_count == 1;
  for (std::size_t i = 0; i < segments; i += lanes) {
    const auto column = [&](std::size_t vertex) {
      return hn::Sub(hn::NegMulAdd(shift, hn::LoadU(f, d + vertex), hn::LoadU(f, x + vertex)), left);
    };
    const auto step = [&](const float* from) {
      return is_dot ? zero : hn::Sub(hn::LoadU(f, from + i + 1), hn::LoadU(f, from + i));
    };
    const auto begin = column(i), dx = is_dot ? zero : hn::Sub(column(i + 1), begin), dy = step(y);
    const auto squared = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
    const auto has_length = hn::Gt(squared, zero);
    const auto length = hn::Sqrt(squared);
    const auto inverse = hn::IfThenElseZero(has_length, hn::Div(one, length));
    hn::StoreU(begin, f, chain.x.data() + i);
    hn::StoreU(hn::Sub(hn::LoadU(f, y + i), top), f, chain.y.data() + i);
    hn::StoreU(dx, f, chain.dx.data() + i);
    hn::StoreU(dy, f, chain.dy.data() + i);
    hn::StoreU(hn::LoadU(f, d + i), f, chain.disparity.data() + i);
    hn::StoreU(step(d), f, chain.disparity_step.data() + i);
    hn::StoreU(hn::Mul(hn::Mul(dx, inverse), inverse), f, chain.along_x.data() + i);
    hn::StoreU(hn::Mul(hn::Mul(dy, inverse), inverse), f, chain.along_y.data() + i);
    hn::StoreU(hn::IfThenElse(has_length, hn::Mul(dx, inverse), one), f, chain.course_x.data() + i);
    hn::StoreU(hn::Mul(dy, inverse), f, chain.course_y.data() + i);
    hn::StoreU(length, f, chain.length.data() + i);
    hn::StoreU(hn::LoadU(f, layer.flat.along.data() + stroke.first_vertex + i), f, chain.begins_px.data() + i);
  }
}

/// The rectangles that the segments paint. A segment is evaluated only where the nearest point of the chain may be its
/// own: beside it, and outside the bend at its end.
void find_rectangles(std::size_t segments, float reach, DistanceBand& band) {
  constexpr float rounding_px = 1.f / 32, least = 1e-6f;  // the latter in place of 0, which divides
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const std::size_t lanes = hn::Lanes(f);
  Chain& chain = band.chain;
  const auto zero = hn::Zero(f), half = hn::Set(f, 0.5f), rounding = hn::Set(f, rounding_px);
  const auto across = hn::Set(f, reach + rounding_px);
  const auto not_zero = [&](auto value) { return hn::CopySign(hn::Max(hn::Abs(value), hn::Set(f, least)), value); };
  for (std::size_t i = 0; i < segments; i += lanes) {
    const auto course_x = hn::LoadU(f, chain.course_x.data() + i), course_y = hn::LoadU(f, chain.course_y.data() + i);
    const auto next_x = hn::LoadU(f, chain.course_x.data() + i + 1),
               next_y = hn::LoadU(f, chain.course_y.data() + i + 1);
    const auto length = hn::LoadU(f, chain.length.data() + i), next = hn::LoadU(f, chain.length.data() + i + 1);
    const auto number = counted_from(f, static_cast<float>(i));
    const auto turns = hn::Abs(hn::Sub(hn::Mul(course_x, next_y), hn::Mul(course_y, next_x)));
    const auto ahead = hn::MulAdd(course_x, next_x, hn::Mul(course_y, next_y));
    const auto is_dot = hn::Eq(length, zero);
    const auto is_last = hn::Eq(number, hn::Set(f, static_cast<float>(segments - 1)));
    const auto whole = hn::Or(hn::Or(is_dot, is_last), hn::Or(hn::Le(ahead, zero), hn::Eq(next, zero)));
    const auto beyond = hn::IfThenElse(whole, across, hn::MulAdd(across, turns, rounding));
    const auto before = hn::IfThenElse(hn::Or(is_dot, hn::Eq(number, zero)), across, rounding);

    const auto along_x = not_zero(course_x), across_x = not_zero(course_y);
    const auto end = hn::Add(length, beyond);
    hn::StoreU(hn::Div(hn::Neg(course_y), along_x), f, chain.along_slope.data() + i);
    hn::StoreU(hn::Div(hn::Mul(hn::Sub(end, before), half), along_x), f, chain.along_middle.data() + i);
    hn::StoreU(hn::Div(hn::Mul(hn::Add(end, before), half), hn::Abs(along_x)), f, chain.along_half.data() + i);
    hn::StoreU(hn::Div(course_x, across_x), f, chain.across_slope.data() + i);
    hn::StoreU(hn::Div(across, hn::Abs(across_x)), f, chain.across_half.data() + i);

    const auto y = hn::LoadU(f, chain.y.data() + i), height = hn::Mul(across, hn::Abs(course_x));
    const auto from = hn::Neg(hn::Mul(before, course_y)), to = hn::Mul(end, course_y);
    const auto row = [&](auto place) {  // truncation is floor where it matters
      return hn::Min(hn::Max(hn::ConvertTo(integers, place), hn::Set(integers, band.first_row)),
                     hn::Set(integers, band.end_row));
    };
    hn::StoreU(row(hn::Add(y, hn::Sub(hn::Min(from, to), height))), integers, chain.first_row.data() + i);
    hn::StoreU(row(hn::Add(hn::Add(y, hn::Set(f, 1.f)), hn::Add(hn::Max(from, to), height))), integers,
               chain.end_row.data() + i);
  }
}

/// Notes the columns of the band's rows that a segment paints.
void find_columns(std::size_t segment, int canvas_width, DistanceBand& band) {
  const Floats f;
  const hn::RebindToSigned<Floats> integers;
  const int lanes = static_cast<int>(hn::Lanes(f));
  Chain& chain = band.chain;
  const auto along_slope = hn::Set(f, chain.along_slope[segment]),
             along_middle = hn::Set(f, chain.along_middle[segment]);
  const auto along_half = hn::Set(f, chain.along_half[segment]), across_half = hn::Set(f, chain.across_half[segment]);
  const auto across_slope = hn::Set(f, chain.across_slope[segment]);
  const auto first_column = hn::Set(f, chain.x[segment] + 0.5f);
  const auto zero = hn::Zero(f), width = hn::Set(f, static_cast<float>(canvas_width));
  const float first_y = 0.5f - chain.y[segment];
  for (int row = chain.first_row[segment]; row < chain.end_row[segment]; row += lanes) {
    const auto y = counted_from(f, static_cast<float>(row) + first_y);
    const auto along = hn::MulAdd(y, along_slope, along_middle), across = hn::Mul(y, across_slope);
    const auto first = hn::Max(hn::Sub(along, along_half), hn::Sub(across, across_half));
    const auto last = hn::Min(hn::Add(along, along_half), hn::Add(across, across_half));
    const auto in_canvas = [&](auto x) {
      return hn::ConvertTo(integers, hn::Min(hn::Max(hn::Add(x, first_column), zero), width));
    };
    const auto begin = in_canvas(first), end = in_canvas(last);
    const std::size_t at = segment * band_rows + static_cast<std::size_t>(row);
    hn::StoreU(begin, integers, chain.begin.data() + at);
    hn::StoreU(end, integers, chain.end.data() + at);
    const auto is_painted =
        hn::And(hn::Lt(begin, end), hn::Lt(counted_from(integers, row), hn::Set(integers, band.end_row)));
    const auto least = hn::LoadU(integers, band.begin.data() + row), most = hn::LoadU(integers, band.end.data() + row);
    hn::StoreU(hn::IfThenElse(is_painted, hn::Min(least, begin), least), integers, band.begin.data() + row);
    hn::StoreU(hn::IfThenElse(is_painted, hn::Max(most, end), most), integers, band.end.data() + row);
  }
}

void find_band_extents(const SeenLayer& layer, const FlatStroke& stroke, int canvas_width, float aside_px,
                       DistanceBand& band) {
  const float reach = BrushProfile(stroke.radius_px).reach_px;
  const auto band_top = static_cast<float>(band.top);
  band.first_row = std::max(static_cast<int>(stroke.top - reach - band_top), 0);
  band.end_row = std::min(static_cast<int>(stroke.bottom + reach - band_top + 1), band.row_count);
  for (int row = band.first_row; row < band.end_row; ++row) {
    band.begin[row] = canvas_width;
    band.end[row] = 0;
  }
  const std::size_t segments = std::max(stroke.vertex_count, 2u) - 1;
  band.chain.resize(segments);
  place_chain(layer, stroke, band.top, band.chain);
  find_rectangles(segments, reach + aside_px, band);
  for (std::size_t i = 0; i < segments; ++i) find_columns(i, canvas_width, band);
}

/// One segment's places along and across the stroke, which are linear in the pixel.
struct PlacesOfSegment {
  PlacesOfSegment(const FlatStroke& stroke, std::size_t segment, std::size_t segments, const Chain& chain)
      : begin(hn::Set(f, chain.begins_px[segment])),
        length(hn::Set(
            f, (segment + 1 < segments ? chain.begins_px[segment + 1] : stroke.length) - chain.begins_px[segment])),
        least(hn::Set(f, segment == 0 ? -ends : 0.f)),
        most(hn::Set(f, segment + 1 == segments ? ends : 1.f)),
        course_x(hn::Set(f, chain.course_x[segment])),
        course_y(hn::Set(f, chain.course_y[segment])),
        facing(hn::Set(f, light_x * chain.course_y[segment] - light_y * chain.course_x[segment])) {}

  static constexpr float ends = 1e6f;  ///< the first and the last segment go on
  static constexpr float light_x = 0.6f, light_y = 0.8f;
  Floats f;
  hn::Vec<Floats> begin, length, least, most, course_x, course_y, facing;
};

/// Lowers the band's distances to those of one segment, over the pixels that it paints; `tested`: except where a
/// surface hides it. `placed`: also notes the places along and across the stroke.
template <bool tested, bool placed>
void lower_to_segment(const FlatStroke& stroke, std::size_t segment, const HiddenBelow& below, DistanceBand& band) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const Chain& chain = band.chain;
  const float first_x = 0.5f - chain.x[segment], first_y = 0.5f - chain.y[segment];
  const auto dx = hn::Set(f, chain.dx[segment]), dy = hn::Set(f, chain.dy[segment]);
  const auto disparity = hn::Set(f, chain.disparity[segment]);
  const auto disparity_step = hn::Set(f, chain.disparity_step[segment]);
  const auto along_x = hn::Set(f, chain.along_x[segment]);
  const auto zero = hn::Zero(f), one = hn::Set(f, 1.f), far = hn::Set(f, far_away);
  const auto step = hn::Set(f, static_cast<float>(lanes));
  // Local copies, because compilers cannot exclude that the stores below change the originals.
  const int *begins = chain.begin.data() + segment * band_rows, *ends = chain.end.data() + segment * band_rows;
  const int *band_begins = band.begin.data(), *band_ends = band.end.data();
  const std::ptrdiff_t stride = band.stride;
  float* const band_squared = band.squared.data();
  const float* const all_hidden_below = below.pixels.data();
  const float along_y_step = chain.along_y[segment];
  const PlacesOfSegment places(stroke, segment, std::max(stroke.vertex_count, 2u) - 1, chain);
  const int end_row = chain.end_row[segment];
  for (int row = chain.first_row[segment]; row < end_row; ++row) {
    const int begin = std::max(begins[row], band_begins[row]), end = std::min(ends[row], band_ends[row]);
    if (begin >= end) continue;
    const float pixel_y = static_cast<float>(row) + first_y;
    const auto py = hn::Set(f, pixel_y);
    const auto along_y = hn::Set(f, pixel_y * along_y_step);
    float* const squared = band_squared + row * stride;
    const float* const hidden_below = tested ? all_hidden_below + row * stride : nullptr;
    auto px = counted_from(f, static_cast<float>(begin) + first_x);
    const auto end_x = hn::Set(f, static_cast<float>(end) - 0.5f + first_x);
    for (int x = begin; x < end; x += lanes) {
      const auto along = hn::MulAdd(px, along_x, along_y);
      const auto t = hn::Min(hn::Max(along, zero), one);
      const auto ex = hn::NegMulAdd(t, dx, px);
      const auto ey = hn::NegMulAdd(t, dy, py);
      auto distance = hn::MulAdd(ex, ex, hn::Mul(ey, ey));
      if constexpr (tested) {
        // Columns from `end` on keep their distances: they show another segment's paint, which a surface may hide
        // there.
        const auto is_hidden =
            hn::Or(hn::Ge(px, end_x), hn::Lt(hn::MulAdd(t, disparity_step, disparity), hn::LoadU(f, hidden_below + x)));
        distance = hn::IfThenElse(is_hidden, far, distance);
      }
      const auto before = hn::LoadU(f, squared + x);
      hn::StoreU(hn::Min(before, distance), f, squared + x);
      if constexpr (placed) {
        const auto is_nearer = hn::Lt(distance, before);
        const auto note = [&](auto value, std::vector<float>& plane) {
          float* const to = plane.data() + row * stride + x;
          hn::StoreU(hn::IfThenElse(is_nearer, value, hn::LoadU(f, to)), f, to);
        };
        note(hn::MulAdd(hn::Min(hn::Max(along, places.least), places.most), places.length, places.begin), band.along);
        note(hn::NegMulAdd(places.course_y, px, hn::Mul(places.course_x, py)), band.across);
        note(places.facing, band.facing);
      }
      px = hn::Add(px, step);
    }
  }
}

/// Whether a surface of the band may hide some of a stroke.
bool may_be_hidden(const FlatStroke& stroke, const HiddenBelow& below, const DistanceBand& band) {
  if (below.pixels.empty()) return false;
  int begin = band.stride, end = 0;
  for (int row = band.first_row; row < band.end_row; ++row) {
    begin = std::min(begin, band.begin[row]);
    end = std::max(end, band.end[row]);
  }
  for (int block = begin / HiddenBelow::block_px; block * HiddenBelow::block_px < end; ++block)
    if (stroke.farthest_disparity < below.blocks[static_cast<std::size_t>(block)].most) return true;
  return false;
}

void measure_band(const FlatStroke& stroke, const HiddenBelow& below, bool with_places, DistanceBand& band) {
  if (with_places)
    for (std::vector<float>* plane : {&band.along, &band.across, &band.facing}) plane->resize(band.squared.size());
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto far = hn::Set(f, far_away);
  for (int row = band.first_row; row < band.end_row; ++row) {
    float* const squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    const int end = band.end[row];
    for (int x = band.begin[row]; x < end; x += lanes) hn::StoreU(far, f, squared + x);
  }
  const bool tested = may_be_hidden(stroke, below, band);
  const std::size_t segments = std::max(stroke.vertex_count, 2u) - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    if (with_places) {
      tested ? lower_to_segment<true, true>(stroke, i, below, band)
             : lower_to_segment<false, true>(stroke, i, below, band);
    } else {
      tested ? lower_to_segment<true, false>(stroke, i, below, band)
             : lower_to_segment<false, false>(stroke, i, below, band);
    }
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(find_band_extents);
HWY_EXPORT(measure_band);

void find_extents(const SeenLayer& layer, const FlatStroke& stroke, int canvas_width, float aside_px,
                  DistanceBand& band) {
  HWY_DYNAMIC_DISPATCH(find_band_extents)(layer, stroke, canvas_width, aside_px, band);
}

void measure_distances(const FlatStroke& stroke, const HiddenBelow& below, bool with_places, DistanceBand& band) {
  HWY_DYNAMIC_DISPATCH(measure_band)(stroke, below, with_places, band);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
