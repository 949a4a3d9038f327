#include "wheatstone/depth/depth_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::wrong_usage, message); }

/// A point of a curve: parallax over w = 1/depth.
struct Knot {
  double w, parallax, slope;
};

/// Slopes at which no cubic between neighbours turns: the harmonic mean of the two sides' slopes, weighted by their
/// lengths, never steeper than three times either (Fritsch & Carlson 1980; Fritsch & Butland 1984).
void choose_slopes(std::vector<Knot>& knots) {
  const std::size_t n = knots.size();
  std::vector<double> length(n - 1), secant(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    length[k] = knots[k + 1].w - knots[k].w;
    secant[k] = (knots[k + 1].parallax - knots[k].parallax) / length[k];
  }
  knots.front().slope = secant.front();
  knots.back().slope = secant.back();
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (secant[k - 1] * secant[k] <= 0) continue;
    const double before = 2 * length[k] + length[k - 1];
    const double after = length[k] + 2 * length[k - 1];
    knots[k].slope = (before + after) / (before / secant[k - 1] + after / secant[k]);
  }
}

/// The cubic of two knots, at a share of the way between them.
double hermite(const Knot& a, const Knot& b, double t) {
  const double length = b.w - a.w;
  const double u = 1 - t;
  return u * u * ((1 + 2 * t) * a.parallax + t * length * a.slope) +
         t * t * ((1 + 2 * u) * b.parallax - u * length * b.slope);
}

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
  std::vector<Knot> knots;
  for (const DepthMapping::Point& point : through.points) knots.push_back({1.0 / point.depth, point.parallax_px, 0});
  choose_slopes(knots);
  DepthMapping curve;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    curve.points.push_back(through.points[k]);
    for (int i = 1; i < samples; ++i) {
      const double t = static_cast<double>(i) / samples;
      const auto depth = static_cast<float>(1 / (knots[k].w + t * (knots[k + 1].w - knots[k].w)));
      // Rounding must neither turn the curve nor put two samples at one depth.
      const DepthMapping::Point& last = curve.points.back();
      const DepthMapping::Point& end = through.points[k + 1];
      if (depth <= last.depth || depth >= end.depth) continue;
      const auto parallax = static_cast<float>(hermite(knots[k], knots[k + 1], t));
      curve.points.push_back({depth, std::clamp(parallax, last.parallax_px, end.parallax_px)});
    }
  }
  curve.points.push_back(through.points.back());
  return curve;
}

}  // namespace wheatstone
