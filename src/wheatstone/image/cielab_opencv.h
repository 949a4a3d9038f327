#pragma once

#include <opencv2/core.hpp>

namespace wheatstone {

/// The L*, a* and b* (image/cielab_internal.h) of a picture, 8-bit RGB, as three channels of 32-bit float.
cv::Mat cielab_of(const cv::Mat& rgb);

}  // namespace wheatstone
