#include "wheatstone/depth/depth_mapping.h"

#include <algorithm>

namespace wheatstone {

float parallax_px(const DepthMapping& mapping, float depth) {
  const auto& points = mapping.points;
  const auto next = std::ranges::upper_bound(points, depth, {}, &DepthMapping::Point::depth);
  if (next == points.begin()) return points.front().parallax_px;
  if (next == points.end()) return points.back().parallax_px;
  const DepthMapping::Point& before = *(next - 1);
  const float share = (1 / before.depth - 1 / depth) / (1 / before.depth - 1 / next->depth);
  return before.parallax_px + share * (next->parallax_px - before.parallax_px);
}

}  // namespace wheatstone
