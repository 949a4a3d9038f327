#include "wheatstone/curves/carried_edges_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace wheatstone {

CarriedEdges::CarriedEdges(const DiffusionMemory& before, const FlowPair& flow, std::span<const View> views,
                           ImageView<const float> disparity, float depth_threshold_px)
    : memory_(before),
      flow_(flow),
      views_(views),
      disparity_(disparity),
      depth_threshold_px_(depth_threshold_px),
      point_at_(views.size(), Image<std::uint32_t>(disparity.width(), disparity.height())) {
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    const CarriedEdge& point = before.points[i];
    if (point.view >= views.size()) continue;
    const int x = static_cast<int>(std::floor(point.x)), y = static_cast<int>(std::floor(point.y));
    if (disparity.contains(x, y)) point_at_[point.view](x, y) = static_cast<std::uint32_t>(i) + 1;
  }
}

Image<std::uint8_t> CarriedEdges::known_edges() const {
  Image<std::uint8_t> known(disparity_.width(), disparity_.height());
  tbb::parallel_for(0, known.height(), [&](int y) {
    for (int x = 0; x < known.width(); ++x) {
      const auto was = before(PlanePoint{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
      if (was) known(x, y) = memory_.edges(static_cast<int>(was->x), static_cast<int>(was->y));
    }
  });
  return known;
}

/// Where a place of the reference view was, within the picture, where the flow agrees both ways.
std::optional<PlanePoint> CarriedEdges::before(PlanePoint at) const {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  if (!disparity_.contains(x, y)) return std::nullopt;
  const float bx = flow_.backward.x(x, y), by = flow_.backward.y(x, y);
  const PlanePoint was{at.x + bx, at.y + by};
  // Comparisons with the unknown are false.
  if (!(was.x >= 0 && was.y >= 0 && was.x < static_cast<float>(disparity_.width()) &&
        was.y < static_cast<float>(disparity_.height())))
    return std::nullopt;
  const float fx = sample(flow_.forward.x.view(), was.x, was.y), fy = sample(flow_.forward.y.view(), was.x, was.y);
  if (!undo_each_other(fx, fy, bx, by)) return std::nullopt;
  return was;
}

std::optional<PlanePoint> CarriedEdges::before(const SurfacePoint& point) const {
  const View& view = views_[point.view];
  const float from_reference = view.position - views_[0].position;
  const auto left = static_cast<float>(view.frame.origin_px);
  const PlanePoint in_reference{point.at.x + left + from_reference * point.disparity, point.at.y};
  const int x = static_cast<int>(std::floor(in_reference.x)), y = static_cast<int>(std::floor(in_reference.y));
  if (!disparity_.contains(x, y) || std::abs(disparity_(x, y) - point.disparity) > depth_threshold_px_)
    return std::nullopt;
  const auto was = before(in_reference);
  if (!was || point.view == 0) return was;
  const float disparity = sample(memory_.disparity.view(), was->x, was->y);
  if (std::abs(disparity - point.disparity) > depth_threshold_px_) return std::nullopt;
  return PlanePoint{was->x - from_reference * disparity - left, was->y};
}

std::optional<EdgeBefore> CarriedEdges::find(PlanePoint at, Direction across, const SurfacePoint& carrier) const {
  constexpr float farthest_px = 1.6f, most_along_px = 2.1f, most_turned = 0.75f;
  const auto carrier_before = before(carrier);
  if (!carrier_before) return std::nullopt;
  const float was_x = carrier_before->x + at.x - carrier.at.x, was_y = carrier_before->y + at.y - carrier.at.y;
  const CarriedEdge* nearest = nullptr;
  float least = farthest_px * farthest_px + most_along_px * most_along_px, shift = 0;
  constexpr int reach = 3;
  const int middle_x = static_cast<int>(std::floor(was_x)), middle_y = static_cast<int>(std::floor(was_y));
  const Image<std::uint32_t>& points = point_at_[carrier.view];
  for (int y = std::max(middle_y - reach, 0); y <= std::min(middle_y + reach, points.height() - 1); ++y) {
    for (int x = std::max(middle_x - reach, 0); x <= std::min(middle_x + reach, points.width() - 1); ++x) {
      if (points(x, y) == 0) continue;
      const CarriedEdge& edge = memory_.points[points(x, y) - 1];
      const float dx = edge.x - was_x, dy = edge.y - was_y, distance = dx * dx + dy * dy;
      const float apart = dx * across.x + dy * across.y, along = dy * across.x - dx * across.y;
      if (distance >= least || std::abs(apart) > farthest_px || std::abs(along) > most_along_px ||
          std::abs(edge.across_x * across.x + edge.across_y * across.y) < most_turned)
        continue;
      nearest = &edge;
      least = distance;
      shift = apart;
    }
  }
  if (nearest == nullptr) return std::nullopt;
  const bool turned = nearest->across_x * across.x + nearest->across_y * across.y < 0;
  const int first = turned ? 1 : 0;
  return EdgeBefore{shift,
                    {nearest->colours[first], nearest->colours[1 - first]},
                    {nearest->disparities[first], nearest->disparities[1 - first]}};
}

}  // namespace wheatstone
