#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/image/image.h"

namespace wheatstone {

struct WeightedMedianOptions {
  int radius_px = 6;
  int step_px = 3;  ///< between the pixels of the window that are asked
};

/// The median of each pixel's surroundings, in which pixels of like colour count most (Ma et al. 2013, "Constant time
/// weighted median filtering for stereo matching and beyond"): streaks and ragged edges go, the picture's edges stay.
/// Where the surroundings differ by a pixel at most, or a thousandth of the width, nothing changes. `picture` is 8-bit
/// RGB; every disparity is known.
Image<float> weighted_median(const Image<float>& disparity, const cv::Mat& picture,
                             const WeightedMedianOptions& options = {});

}  // namespace wheatstone
