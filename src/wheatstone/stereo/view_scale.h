#pragma once

#include <span>
#include <vector>

#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// A smaller view in which each `factor` by `factor` pixels become one; the same view for a factor of 1. The parts that
/// only one view sees are small, and the cost of planning them is mostly proportional to the number of pixels. A pixel
/// in which several surfaces are united belongs to the farthest wanted one, and has its colour, because paint of a
/// nearer one would spill over what lies behind it. An incomplete last row or column is left out.
View smaller_view(const View& view, int factor);

/// A smaller view `factor` times as large, in pictures of this size; the same view for a factor of 1. Border pixels
/// that the smaller pictures left out repeat their neighbours.
View larger_view(const View& view, int factor, int width, int height);

/// A scene whose views are all of the reference view's scale. Views that have this scale already share their images
/// with the result.
std::vector<View> at_reference_scale(std::span<const View> views);

}  // namespace wheatstone
