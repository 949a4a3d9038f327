#include "wheatstone/particles/framed_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "wheatstone/particles/cloud_statistics.h"

namespace wheatstone {
namespace {

std::array<std::vector<float>, 3> sampled_axes(const CloudStatistics& statistics) {
  const Cloud& sample = statistics.sample.cloud();
  return {sample.x, sample.y, sample.z};
}

/// The bounds along each axis without so many values at either end.
FramedRegion trimmed(const std::array<std::vector<float>, 3>& axes, std::size_t ends) {
  FramedRegion region;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float> values = axes[axis];
    const std::size_t cut = std::min(ends, (values.size() - 1) / 2);
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(cut);
    const auto last = values.end() - 1 - static_cast<std::ptrdiff_t>(cut);
    std::ranges::nth_element(values, first);
    region.lower[axis] = *first;
    std::ranges::nth_element(values, last);
    region.upper[axis] = *last;
  }
  return region;
}

/// How many are left out at either end of an axis.
std::size_t ends_of(double share, std::size_t count) {
  return static_cast<std::size_t>(std::ceil((1 - share) / 2 * static_cast<double>(count) - 1e-9));
}

/// The bounds of those that lie in a region or less than half its radius from it.
FramedRegion grown(const FramedRegion& region, const std::array<std::vector<float>, 3>& axes) {
  const float margin = region.radius() / 2;
  FramedRegion bounds = region;
  for (std::size_t i = 0; i < axes[0].size(); ++i) {
    bool near = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      near = near && axes[axis][i] >= region.lower[axis] - margin && axes[axis][i] <= region.upper[axis] + margin;
    for (std::size_t axis = 0; near && axis < 3; ++axis) {
      bounds.lower[axis] = std::min(bounds.lower[axis], axes[axis][i]);
      bounds.upper[axis] = std::max(bounds.upper[axis], axes[axis][i]);
    }
  }
  return bounds;
}

FramedRegion usual_region(const CloudStatistics& statistics) {
  const FramedRegion all{.lower = statistics.lower, .upper = statistics.upper};
  constexpr std::size_t too_few = 10;
  constexpr double share = 0.998;
  constexpr float far_out = 2;
  const std::array<std::vector<float>, 3> axes = sampled_axes(statistics);
  if (axes[0].size() < too_few) return all;
  const FramedRegion most = trimmed(axes, std::max<std::size_t>(ends_of(share, axes[0].size()), 1));
  if (most.lower == most.upper || all.radius() <= far_out * most.radius()) return all;
  return grown(most, axes);
}

}  // namespace

std::array<float, 3> FramedRegion::centre() const {
  return {(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2};
}

float FramedRegion::radius() const {
  if (sphere_radius > 0) return sphere_radius;
  const float radius = std::hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]) / 2;
  return radius > 0 ? radius : 1.f;
}

FramedRegion framed_region(const CloudStatistics& statistics, const Fit& fit) {
  FramedRegion region{.lower = statistics.lower, .upper = statistics.upper};
  const auto put = [&](std::array<float, 3>& to, const std::array<double, 3>& point, double further) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      to[axis] = static_cast<float>(point[axis] - statistics.origin[axis] + further);
  };
  if (fit.index() == 0) return usual_region(statistics);
  if (const FitShare* share = std::get_if<FitShare>(&fit)) {
    const std::array<std::vector<float>, 3> axes = sampled_axes(statistics);
    const std::size_t ends = ends_of(share->share, axes[0].size());
    if (ends > 0) return trimmed(axes, ends);
  } else if (const Sphere* sphere = std::get_if<Sphere>(&fit)) {
    put(region.lower, sphere->centre, -sphere->radius);
    put(region.upper, sphere->centre, sphere->radius);
    region.sphere_radius = static_cast<float>(sphere->radius);
  } else if (const Box* box = std::get_if<Box>(&fit)) {
    put(region.lower, box->lower, 0);
    put(region.upper, box->upper, 0);
  }
  return region;
}

std::uint64_t count_outside(const Cloud& cloud, const FramedRegion& region) {
  const auto& [lower, upper, sphere_radius] = region;
  const std::array<float, 3> middle = region.centre();
  // Of a box the sphere around it says nothing.
  const float square = sphere_radius > 0 ? sphere_radius * sphere_radius : std::numeric_limits<float>::infinity();
  // Without branches, several particles at a time.
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float x = cloud.x[i], y = cloud.y[i], z = cloud.z[i];
    const float dx = x - middle[0], dy = y - middle[1], dz = z - middle[2];
    const int in_box = int{x >= lower[0]} & int{x <= upper[0]} & int{y >= lower[1]} & int{y <= upper[1]} &
                       int{z >= lower[2]} & int{z <= upper[2]};
    outside += static_cast<unsigned>(1 - (in_box & int{dx * dx + dy * dy + dz * dz <= square}));
  }
  return outside;
}

}  // namespace wheatstone
