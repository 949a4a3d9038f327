#pragma once

#include <span>
#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// What becomes of a picture's disparities, in its pixels: a line between each two of the points, of which the first
/// numbers ascend and the second do not descend. Beyond its ends a disparity becomes what it becomes there; without
/// points it stays.
struct DisparityMapping {
  struct Point {
    float from_px = 0;
    float to_px = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  std::vector<Point> points;
  friend bool operator==(const DisparityMapping&, const DisparityMapping&) = default;
};

/// NaN, an unknown disparity, stays.
float mapped_px(const DisparityMapping& mapping, float disparity_px);

/// The mapping by which the places of a picture as wide as the screen, `viewing.width_px` pixels, seem where the
/// regions have them, with disparity 0 on the screen. Shares count disparities, from `ends.nearest_px`, 0, to
/// `ends.farthest_px`, 1. Throws Error{wrong_usage} where a place is behind the viewer.
DisparityMapping disparity_mapping(std::span<const DepthRegion> regions, const DepthEnds& ends,
                                   const ViewingGeometry& viewing);

}  // namespace wheatstone
