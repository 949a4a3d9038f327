#include "wheatstone/depth/disparity_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {

float mapped_px(const DisparityMapping& mapping, float disparity_px) {
  const auto& points = mapping.points;
  if (points.empty() || std::isnan(disparity_px)) return disparity_px;
  const auto next = std::ranges::upper_bound(points, disparity_px, {}, &DisparityMapping::Point::from_px);
  if (next == points.begin()) return points.front().to_px;
  if (next == points.end()) return points.back().to_px;
  const DisparityMapping::Point& before = *(next - 1);
  // In doubles a mapping of everything to itself changes no bit.
  const double share =
      (static_cast<double>(disparity_px) - before.from_px) / (static_cast<double>(next->from_px) - before.from_px);
  return static_cast<float>(before.to_px + share * (static_cast<double>(next->to_px) - before.to_px));
}

DisparityMapping disparity_mapping(std::span<const DepthRegion> regions, const DepthEnds& ends,
                                   const ViewingGeometry& viewing) {
  DisparityMapping mapping;
  const float least_range_px = 1e-3f;  // of a flat picture
  const float range_px = std::max(ends.nearest_px - ends.farthest_px, least_range_px);
  for (const DepthRegion& region : regions) {
    if (!(region.behind_mm > -viewing.viewing_distance_mm))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("a place {:.0f} mm in front of the screen is behind the viewer, who is {:.0f} mm away",
                              -region.behind_mm, viewing.viewing_distance_mm));
    mapping.points.push_back({ends.nearest_px - region.share * range_px,
                              -screen_parallax_mm(viewing, region.behind_mm) / viewing.pixel_pitch_mm()});
  }
  std::ranges::reverse(mapping.points);
  return mapping;
}

}  // namespace wheatstone
