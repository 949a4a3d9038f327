#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// The photograph without its grain, its edges kept: what regions are cut from.
Image<Rgb8> without_grain(ImageView<const Rgb8> photograph, float scale);

/// What a film's side views are cut from, of which little shows: quicker, and a little rougher.
Image<Rgb8> without_grain_quickly(ImageView<const Rgb8> photograph);

/// The disparity without single outliers.
Image<float> without_outliers(ImageView<const float> disparity);

}  // namespace wheatstone
