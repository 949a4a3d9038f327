#pragma once

#include <vector>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Left and right next to each other at full size, left on the left.
Image<Rgb8> side_by_side(const StereoPairView& pair);

/// Moves the zero-parallax plane to where the disparity is `zero_parallax_px` (Stavrakis & Gelautz 2004, sec. 3.4): the
/// pictures are shifted against each other by that many whole pixels and cropped to what both show, the same height.
/// Points nearer than the plane then stand in front of the screen. Borrows the pictures. Throws Error{wrong_usage}
/// where they show less than a quarter of the width both.
StereoPairView set_convergence(const StereoPairView& pair, float zero_parallax_px);

/// The same for any number of views: each is moved by `disparity_px` to the left against the one on its left, in whole
/// pixels from the middle view, and all are cropped to what all show. Throws Error{wrong_usage} as it does.
std::vector<Image<Rgb8>> shifted_views(std::vector<Image<Rgb8>> views, float disparity_px);

/// Black strips that bring the stereo window before the screen, where something near is cut off by its sides: of
/// `left_px` at the left edge of the left eye's picture and `right_px` at the right edge of the right eye's.
void put_floating_window(StereoPair& pair, int left_px, int right_px);

/// A picture, and beside it on the right how near its pixels are, from black, the farthest, to white (RGB-D). Disparity
/// has the picture's size; unknown is black. Outliers, half a percent at either end, count as the ends.
Image<Rgb8> depth_beside(ImageView<const Rgb8> picture, ImageView<const float> disparity);

}  // namespace wheatstone
