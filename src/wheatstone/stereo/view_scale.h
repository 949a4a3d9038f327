#pragma once

#include <span>
#include <vector>

#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// A view of which each `factor` by `factor` pixels become one; the same view for a factor of 1. What only one view
/// sees is small, and planning it costs mostly as much as there are pixels to look at. Where pixels of several surfaces
/// become one, it is of the farthest that is wanted, and has that one's colour: paint of a nearer one would spill over
/// what lies behind it. A last row or column that is not whole is left out.
View smaller_view(const View& view, int factor);

/// A smaller view `factor` times as large, in pictures of this size; the same view for a factor of 1. What the smaller
/// pictures left out at the border is as beside it.
View larger_view(const View& view, int factor, int width, int height);

/// A scene whose views are all of the reference view's scale. Of those that are already, it shares the images.
std::vector<View> at_reference_scale(std::span<const View> views);

}  // namespace wheatstone
