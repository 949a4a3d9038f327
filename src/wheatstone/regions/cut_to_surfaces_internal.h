#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/regions/region_map_internal.h"

namespace wheatstone {

/// The parts of a map's regions, each of which follows its surface, and the number of the region that each is of.
struct SurfaceParts {
  RegionMap parts;
  std::vector<std::int32_t> region;
};

/// A mark's disparity goes evenly along each row, from one side of its outline to the other. Cuts regions across, until
/// what differs from their surface by more than `tolerance_px` in doing so is less than `least_area` pixels of each
/// part, so that surfaces do not hide marks that lie on them. Neighbours whose disparities differ by more than
/// `threshold_px` are in different parts, as in the map's regions.
SurfaceParts cut_to_surfaces(const RegionMap& regions, ImageView<const float> disparity, float threshold_px,
                             float tolerance_px, std::int64_t least_area);

}  // namespace wheatstone
