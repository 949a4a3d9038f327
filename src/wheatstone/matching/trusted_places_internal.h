#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/semi_global_internal.h"

namespace wheatstone {

/// 255 in large parts of the left picture (8-bit RGB) that show nothing but noise and match at no disparity better than
/// at others, up to the edges around: a white ground, a clear sky. What is found there is chance, or was carried there
/// from an edge.
cv::Mat plain_places(const cv::Mat& picture, const BandMatch& match);

/// 255 where the surroundings of a pixel match at its disparity clearly better than at others of its band.
cv::Mat distinct_places(const BandMatch& match);

}  // namespace wheatstone
