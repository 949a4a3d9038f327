#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// 255 for the pixels of the left view whose disparity is known and whose counterpart in the right view lies in the
/// picture and is not hidden: a z-buffer, into whose pixels every left pixel falls, holds nothing there that is nearer
/// by more than a pixel.
Image<std::uint8_t> visible_in_both(ImageView<const float> left_disparity);

/// How alike the two eyes' pictures of the same points are: L(x) − R(x − d) over the pixels visible in both, R
/// interpolated along the scan line.
struct LeftRightDifference {
  double mean_absolute = 0;   ///< over pixels and channels, 0..255
  double rmse = 0;            ///< over pixels and channels, 0..1
  double compared_share = 0;  ///< of the left picture's pixels
};

/// `left_disparity` is the truth, or what is taken for it; NaN where it is unknown. Throws Error{bad_input} where sizes
/// differ.
LeftRightDifference measure_left_right_difference(const StereoPairView& pair, ImageView<const float> left_disparity);

/// Mean squared length of the luminance gradient (Sobel, in steps of 0..255 a pixel): what blurring takes away.
double gradient_energy(ImageView<const Rgb8> picture);

/// Whether the depth that a pair was made with can still be seen in it: the pair is matched again by plain SGBM
/// (OpenCV, 3WAY) and compared with the truth (Bukenberger et al. 2015, fig. 5), over the pixels visible in both views.
struct DepthSurvival {
  double density = 0;          ///< share of the pixels that were matched at all
  double end_point_error = 0;  ///< mean |found − true| over the matched ones, in pixels
  double bad_1 = 0;            ///< share that is unmatched or off by more than 1 pixel
  double bad_2 = 0;            ///< … by more than 2 pixels
};

/// `left_disparity` is the truth, or what is taken for it; NaN where it is unknown. Throws Error{bad_input} where sizes
/// differ.
DepthSurvival measure_depth_survival(const StereoPair& pair, ImageView<const float> left_disparity);

}  // namespace wheatstone
