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

/// Draws discs, moved for the view at `view`, where they are nearer than what was drawn before. Of two equally near
/// discs, the first stays.
void draw_discs(std::span<const Splat> splats, int top, ViewPosition view, OpaqueBand& band);

}  // namespace wheatstone
