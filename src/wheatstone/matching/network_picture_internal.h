#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// A picture (CV_8UC3, red first) of the size that a network takes, as its input 1x3xHxW.
cv::Mat network_picture(const cv::Mat& picture, NetworkValues values);

}  // namespace wheatstone
