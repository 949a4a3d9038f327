#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// Disparity of the first of two 8-bit RGB pictures, in pixels, NaN where nothing was found. One way, unchecked: SGBM
/// 3WAY as measures use it, with the parameters of OpenCV's example: block 5, left-right check 1, uniqueness 10 %,
/// speckles 100 pixels within 2.
Image<float> match_plain_sgbm(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range);

}  // namespace wheatstone
