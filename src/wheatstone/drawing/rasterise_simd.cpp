#include <algorithm>
#include <cmath>

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
void for_each_segment(const FlatLayer& layer, const FlatStroke& stroke, Visit visit) {
  const float* x = layer.x.data() + stroke.first_vertex;
  const float* y = layer.y.data() + stroke.first_vertex;
  if (stroke.vertex_count == 1) visit(Segment{x[0], y[0], 0, 0});
  for (std::uint32_t i = 1; i < stroke.vertex_count; ++i)
    visit(Segment{x[i - 1], y[i - 1], x[i] - x[i - 1], y[i] - y[i - 1]});
}

/// Notes the rows and columns of the band that the stroke touches.
void find_extents(const FlatLayer& layer, const FlatStroke& stroke, float reach, int canvas_width, DistanceBand& band) {
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

/// Lowers the band's distances to those of one segment, over the pixels that the brush touches.
void lower_to_segment(const Segment& segment, const SegmentBox& box, DistanceBand& band) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float squared_length = segment.dx * segment.dx + segment.dy * segment.dy;
  const float inverse = squared_length > 0 ? 1 / squared_length : 0;
  const auto dx = hn::Set(f, segment.dx), dy = hn::Set(f, segment.dy);
  const auto along_x = hn::Set(f, segment.dx * inverse);
  const auto zero = hn::Zero(f), one = hn::Set(f, 1.f);
  const auto step = hn::Set(f, static_cast<float>(lanes));
  const auto first_x = hn::Iota(f, 0.5f - segment.x);
  for (int row = box.first_row; row < box.end_row; ++row) {
    const int begin = std::max(box.begin, band.begin[row]), end = std::min(box.end, band.end[row]);
    const float pixel_y = static_cast<float>(band.top + row) + 0.5f - segment.y;
    const auto py = hn::Set(f, pixel_y);
    const auto along_y = hn::Set(f, pixel_y * segment.dy * inverse);
    float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    auto px = hn::Add(first_x, hn::Set(f, static_cast<float>(begin)));
    for (int x = begin; x < end; x += lanes) {
      const auto t = hn::Min(hn::Max(hn::MulAdd(px, along_x, along_y), zero), one);
      const auto ex = hn::NegMulAdd(t, dx, px);
      const auto ey = hn::NegMulAdd(t, dy, py);
      const auto distance = hn::MulAdd(ex, ex, hn::Mul(ey, ey));
      hn::StoreU(hn::Min(hn::LoadU(f, squared + x), distance), f, squared + x);
      px = hn::Add(px, step);
    }
  }
}

/// Fills the band with the stroke's squared distances, within its extents.
void measure_distances(const FlatLayer& layer, const FlatStroke& stroke, DistanceBand& band) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const auto far = hn::Set(f, far_away);
  for (int row = band.first_row; row < band.end_row; ++row) {
    float* squared = band.squared.data() + static_cast<std::size_t>(row) * band.stride;
    for (int x = band.begin[row]; x < band.end[row]; x += lanes) hn::StoreU(far, f, squared + x);
  }
  const SegmentBox* box = band.boxes.data();
  for_each_segment(layer, stroke, [&](const Segment& segment) { lower_to_segment(segment, *box++, band); });
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
  float* disparity = accumulator.disparity.empty() ? nullptr : accumulator.disparity.data() + offset;
  const auto stroke_disparity = hn::Set(f, stroke.disparity);
  const auto half = hn::Set(f, 0.5f);
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
    const auto left = hn::Sub(through, share);
    hn::StoreU(left, f, light + x);
    if (disparity == nullptr) continue;
    const auto covers_half = hn::And(hn::Gt(through, half), hn::Le(left, half));
    hn::StoreU(hn::IfThenElse(covers_half, stroke_disparity, hn::LoadU(f, disparity + x)), f, disparity + x);
  }
}

/// Notes which blocks of a row still let light through.
void update_open_blocks(const DistanceBand& band, int row, FrontToBackAccumulator& accumulator) {
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float* light = accumulator.light.data() + static_cast<std::size_t>(row) * accumulator.stride;
  const auto dark = hn::Set(f, FrontToBackAccumulator::dark);
  for (int block = band.begin[row] / FrontToBackAccumulator::block_px;
       block * FrontToBackAccumulator::block_px < band.end[row]; ++block) {
    const int end = (block + 1) * FrontToBackAccumulator::block_px;
    bool is_open = false;
    for (int x = block * FrontToBackAccumulator::block_px; x < end; x += lanes)
      is_open = is_open || !hn::AllFalse(f, hn::Gt(hn::LoadU(f, light + x), dark));
    if (!is_open) accumulator.open.close(row, block);
  }
}

void draw_over(const FlatLayer& layer, const FlatStroke& stroke, DistanceBand& band, Canvas& canvas) {
  const BrushProfile brush(stroke.radius_px);
  const Cover cover(brush);
  find_extents(layer, stroke, brush.reach_px, canvas.width, band);
  measure_distances(layer, stroke, band);
  for (int row = band.first_row; row < band.end_row; ++row) lay_over_row(stroke, cover, band, row, canvas);
}

void draw_under(const FlatLayer& layer, const FlatStroke& stroke, DistanceBand& band,
                FrontToBackAccumulator& accumulator) {
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
  measure_distances(layer, stroke, band);
  for (int row = band.first_row; row < band.end_row; ++row) {
    if (band.begin[row] >= band.end[row]) continue;
    slide_under_row(stroke, cover, band, row, accumulator);
    update_open_blocks(band, row, accumulator);
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(draw_over);
HWY_EXPORT(draw_under);

void draw_stroke_over(const FlatLayer& layer, const FlatStroke& stroke, DistanceBand& band, Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(draw_over)(layer, stroke, band, canvas);
}

void draw_stroke_under(const FlatLayer& layer, const FlatStroke& stroke, DistanceBand& band,
                       FrontToBackAccumulator& accumulator) {
  HWY_DYNAMIC_DISPATCH(draw_under)(layer, stroke, band, accumulator);
}

}  // namespace wheatstone
#endif  // HWY_ONCE
