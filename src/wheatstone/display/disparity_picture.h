#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Disparities in false colours for looking at: near is red, far is blue (Turbo), unknown is black. The range is the
/// picture's own, from its 0.5th to its 99.5th percentile.
Image<Rgb8> disparity_picture(ImageView<const float> disparity);

/// The disparity of either eye, half transparent over its grey photograph, of the same size. Both eyes have the colours
/// of the left one's map.
Image<Rgb8> disparity_over(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                           ImageView<const float> left_disparity);

}  // namespace wheatstone
