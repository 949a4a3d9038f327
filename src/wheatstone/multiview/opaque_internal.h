#pragma once

#include <limits>
#include <span>

#include "wheatstone/image/image.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {

/// Opaque particles on a band of scan lines: each pixel's nearest, by parallax.
struct OpaqueBand {
  OpaqueBand() = default;
  OpaqueBand(int left_, int right, int rows)
      : left(left_),
        parallax(right - left_, rows, std::numeric_limits<float>::infinity()),
        light(right - left_, rows) {}
  int left = 0;  ///< column of the view that column 0 is
  Image<float> parallax;
  Image<LinearRgba> light;
};

/// Draws splats of light as lit spheres (light_on_sphere), moved for the view at `view`, where they are nearer than
/// what was drawn before: all of a sphere lies at the depth of its middle. Of two equally near ones, the first stays.
void draw_spheres(std::span<const Splat> splats, int top, ViewPosition view, OpaqueBand& band);

}  // namespace wheatstone
