#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

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
