#include "wheatstone/depth/depth_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/depth/monotone_cubic.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::wrong_usage, message); }

}  // namespace

float parallax_px(const DepthMapping& mapping, float depth) {
  const auto& points = mapping.points;
  const auto next = std::ranges::upper_bound(points, depth, {}, &DepthMapping::Point::depth);
  if (next == points.begin()) return points.front().parallax_px;
  if (next == points.end()) return points.back().parallax_px;
  const DepthMapping::Point& before = *(next - 1);
  // Neighbours of a curve are so close that floats would not tell the differences.
  const double w = 1.0 / before.depth;
  const double share = (w - 1.0 / depth) / (w - 1.0 / next->depth);
  return static_cast<float>(before.parallax_px + share * (static_cast<double>(next->parallax_px) - before.parallax_px));
}

void check_depth_mapping(const DepthMapping& mapping, const std::string& name) {
  if (mapping.points.empty()) refuse(name + ": has no points, expected at least one");
  const DepthMapping::Point* before = nullptr;
  for (const DepthMapping::Point& point : mapping.points) {
    if (!(point.depth > 0) || !std::isfinite(point.parallax_px))
      refuse(fmt::format("{}: has {}:{}, expected depths above 0 and finite parallaxes", name, point.depth,
                         point.parallax_px));
    if (before && !(point.depth > before->depth && point.parallax_px >= before->parallax_px))
      refuse(fmt::format("{}: has {}:{} after {}:{}, expected ascending depths, and parallaxes that do not descend",
                         name, point.depth, point.parallax_px, before->depth, before->parallax_px));
    before = &point;
  }
}

DepthMapping single_region(float nearest, float farthest, const ViewingGeometry& viewing, float near_mm, float far_mm) {
  const std::vector<PlacedDepth> ends{{nearest, -near_mm}, {farthest, far_mm}};
  return many_regions(ends, viewing);
}

DepthMapping many_regions(std::span<const PlacedDepth> placed, const ViewingGeometry& viewing) {
  DepthMapping mapping;
  for (const PlacedDepth& point : placed) {
    if (!(point.behind_mm > -viewing.viewing_distance_mm))
      refuse(fmt::format("a point {:.0f} mm in front of the screen is behind the viewer, who is {:.0f} mm away",
                         -point.behind_mm, viewing.viewing_distance_mm));
    mapping.points.push_back({point.depth, screen_parallax_mm(viewing, point.behind_mm) / viewing.pixel_pitch_mm()});
  }
  check_depth_mapping(mapping);
  return mapping;
}

DepthMapping monotone_curve(const DepthMapping& through, int samples) {
  check_depth_mapping(through);
  if (through.points.size() < 3) return through;
  std::vector<CurvePoint> knots;  // over 1/depth
  for (const DepthMapping::Point& point : through.points) knots.push_back({1.0 / point.depth, point.parallax_px});
  choose_slopes(knots);
  DepthMapping curve;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    curve.points.push_back(through.points[k]);
    for (int i = 1; i < samples; ++i) {
      const double t = static_cast<double>(i) / samples;
      const auto depth = static_cast<float>(1 / (knots[k].at + t * (knots[k + 1].at - knots[k].at)));
      // Rounding must neither turn the curve nor put two samples at one depth.
      const DepthMapping::Point& last = curve.points.back();
      const DepthMapping::Point& end = through.points[k + 1];
      if (depth <= last.depth || depth >= end.depth) continue;
      const auto parallax = static_cast<float>(value_between(knots[k], knots[k + 1], t));
      curve.points.push_back({depth, std::clamp(parallax, last.parallax_px, end.parallax_px)});
    }
  }
  curve.points.push_back(through.points.back());
  return curve;
}

}  // namespace wheatstone
