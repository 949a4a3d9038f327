#pragma once

#include <vector>

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
  };
  std::vector<Point> points;
};

/// Parallax of a depth > 0. The mapping has at least one point.
float parallax_px(const DepthMapping& mapping, float depth);

}  // namespace wheatstone
