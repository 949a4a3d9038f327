#pragma once

#include <span>
#include <string>
#include <vector>

#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// Where a scene depth goes: the screen parallax, in pixels of a view at full eye separation, positive behind the
/// screen. Depth is a length along the line of sight from the reference camera, in scene units.
/// A list of points (depth ascending, parallax not descending). Between two points parallax is linear in 1/depth, as a
/// camera's is: two points are the single-region mapping (Jones et al. 2001, as in Hassaine 2010, sec. 5.3.1), more are
/// many regions (sec. 6.1), dense ones are a curve. Beyond its ends parallax stays what it is there.
struct DepthMapping {
  struct Point {
    float depth;
    float parallax_px;
    friend bool operator==(const Point&, const Point&) = default;
  };
  std::vector<Point> points;
  friend bool operator==(const DepthMapping&, const DepthMapping&) = default;
};

/// Parallax of a depth > 0. The mapping has at least one point.
float parallax_px(const DepthMapping& mapping, float depth);

/// Throws Error{wrong_usage}, beginning with `name`, where the mapping has no points, a depth is not above 0 or not
/// above the one before, a parallax is below the one before, or any is NaN.
void check_depth_mapping(const DepthMapping& mapping, const std::string& name = "depth mapping");

/// One region: the scene's nearest depth seems `near_mm` in front of the screen, its farthest `far_mm` behind it.
/// Throws Error{wrong_usage} where that is behind the viewer, or the depths do not ascend.
DepthMapping single_region(float nearest, float farthest, const ViewingGeometry& viewing, float near_mm, float far_mm);

/// A scene depth, and how far behind the screen it is to seem; negative before it.
struct PlacedDepth {
  float depth;
  float behind_mm;
};

/// Many regions, one between each two neighbours (sec. 6.1). Throws Error{wrong_usage} where they do not ascend, or
/// where one is behind the viewer.
DepthMapping many_regions(std::span<const PlacedDepth> placed, const ViewingGeometry& viewing);

/// A smooth curve through the points of a mapping (fig. 6.1b), without turns between them: cubic in 1/depth, with the
/// slopes of Fritsch & Carlson 1980, sampled so many times between neighbours. Points that one region would join stay
/// one region.
DepthMapping monotone_curve(const DepthMapping& through, int samples = 32);

}  // namespace wheatstone
