#pragma once

#include <opencv2/core.hpp>

namespace wheatstone {

/// The largest upright rectangle, in pixels, that lies wholly where a mask (CV_8UC1) is not 0. Empty where it is 0
/// everywhere.
cv::Rect largest_rectangle_within(const cv::Mat& mask);

}  // namespace wheatstone
