#include "wheatstone/strokes/footprint_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/strokes/footprint_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void measure_segment(const ChainPoint& a, const ChainPoint& b, const FootprintArea& area, float reach_px,
                     int row_length, float* squared, float* along) {
  const hn::CappedTag<float, footprint_padding> f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  const float dx = b.x - a.x, dy = b.y - a.y, squared_length = dx * dx + dy * dy;
  const float inverse = squared_length > 0 ? 1 / squared_length : 0;
  const int left = std::max(static_cast<int>(std::min(a.x, b.x) - reach_px), area.left) - area.left;
  const int right = std::min(static_cast<int>(std::max(a.x, b.x) + reach_px) + 1, area.right) - area.left;
  const float top = std::min(a.y, b.y) - reach_px, bottom = std::max(a.y, b.y) + reach_px;
  const auto across = hn::Set(f, dx), down = hn::Set(f, dy), per_length = hn::Set(f, inverse);
  const auto begins = hn::Set(f, a.along), length = hn::Set(f, b.along - a.along);
  for (int row = 0, y = area.top; y < area.bottom; ++row, y += area.row_step) {
    const float centre = static_cast<float>(y) + 0.5f;
    if (centre < top || centre > bottom) continue;
    float* const squared_row = squared + static_cast<std::ptrdiff_t>(row) * row_length;
    float* const along_row = along + static_cast<std::ptrdiff_t>(row) * row_length;
    const auto from_a_down = hn::Set(f, centre - a.y);
    const auto share_of_row = hn::Mul(from_a_down, down);
    for (int i = left; i < right; i += lanes) {
      const auto from_a = hn::Iota(f, static_cast<float>(area.left + i) + 0.5f - a.x);
      const auto t = hn::Min(hn::Max(hn::Mul(hn::Add(hn::Mul(from_a, across), share_of_row), per_length), hn::Zero(f)),
                             hn::Set(f, 1.f));
      const auto ex = hn::Sub(from_a, hn::Mul(t, across)), ey = hn::Sub(from_a_down, hn::Mul(t, down));
      const auto distance = hn::Add(hn::Mul(ex, ex), hn::Mul(ey, ey));
      const auto before = hn::LoadU(f, squared_row + i);
      const auto nearer = hn::Lt(distance, before);
      hn::StoreU(hn::Min(distance, before), f, squared_row + i);
      hn::BlendedStore(hn::Add(begins, hn::Mul(t, length)), nearer, f, along_row + i);
    }
  }
}

void measure_chain(std::span<const ChainPoint> chain, const FootprintArea& area, float reach_px, int row_length,
                   float* squared, float* along) {
  std::fill_n(squared, static_cast<std::ptrdiff_t>(area.rows()) * row_length, reach_px * reach_px);
  for (std::size_t s = 0; s + 1 < chain.size(); ++s)
    measure_segment(chain[s], chain[s + 1], area, reach_px, row_length, squared, along);
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {

HWY_EXPORT(measure_chain);

void measure_footprint(std::span<const ChainPoint> chain, const FootprintArea& area, float reach_px, int row_length,
                       float* squared, float* along) {
  HWY_DYNAMIC_DISPATCH(measure_chain)(chain, area, reach_px, row_length, squared, along);
}

void Footprint::flatten(std::span<const PlanePoint> controls) {
  chain_.clear();
  if (controls.size() < 3) {
    for (const PlanePoint& point : controls) add(point);
    if (controls.size() == 1) add(controls.front());
    return;
  }
  points_.clear();
  for (const PlanePoint& point : controls) points_.push_back({point.x, point.y, 0});
  const ClampedSpline spline(points_, central_view);
  add(controls.front());
  for (int span = 0; span < spline.span_count(); ++span) {
    const SpatialPoint end = point_on(spline, span, 1);
    add({end.x, end.y});
  }
}

void Footprint::add(PlanePoint point) {
  const float along =
      chain_.empty() ? 0 : chain_.back().along + std::hypot(point.x - chain_.back().x, point.y - chain_.back().y);
  chain_.push_back({point.x, point.y, along});
}

}  // namespace wheatstone
#endif  // HWY_ONCE
