#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Disparities in false colours for looking at: near is red, far is blue (Turbo), unknown is black. The range is the
/// picture's own, from its 0.5th to its 99.5th percentile.
Image<Rgb8> disparity_picture(ImageView<const float> disparity);

/// The same, half transparent over the grey photograph that it belongs to, of the same size.
Image<Rgb8> disparity_over(ImageView<const Rgb8> photograph, ImageView<const float> disparity);

}  // namespace wheatstone
