#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/particles/select.h"

namespace wheatstone {

struct CloudStatistics;

/// All particles are framed.
struct FitAll {};
/// The middle share, 0..1, of the particles along each axis is framed; at least one particle at either end is left out
/// where the share is below 1.
struct FitShare {
  double share;
};
/// What the views are framed by, and their depth with them. A box or sphere is in the file's units. The first is the
/// default: all particles, unless one in a thousand at either end of an axis more than doubles their extent. Those are
/// then left out, so that one far outlier does not make everything else a dot.
using Fit = std::variant<std::monostate, FitAll, FitShare, Sphere, Box>;

/// The part of the scene that the views show, relative to the cloud's origin.
struct FramedRegion {
  std::array<float, 3> lower{}, upper{};
  float sphere_radius = 0;  ///< of the sphere around their middle, where the region is one; 0 where it is the box

  std::array<float, 3> centre() const;
  float radius() const;  ///< of the sphere, or of the sphere around the box; not 0
};

/// The region that a fit asks for, of the particles of which this is known.
FramedRegion framed_region(const CloudStatistics& statistics, const Fit& fit);

/// How many particles lie outside the region.
std::uint64_t count_outside(const Cloud& cloud, const FramedRegion& region);

}  // namespace wheatstone
