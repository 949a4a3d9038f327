#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// 255 where a pixel's surroundings match at its disparity clearly better than at any other of the range, 0 elsewhere:
/// on plain walls, in repeated patterns, and where the disparity is unknown. Two 8-bit RGB pictures; `disparity` is the
/// left one's.
Image<std::uint8_t> find_distinct_matches(const cv::Mat& left, const cv::Mat& right, const Image<float>& disparity,
                                          const DisparityRange& range);

/// Replaces what is not distinct, and what was matched wrongly and is unknown, by the median of the nearest trusted
/// disparities in eight directions (Hirschmüller 2008, sec. 2.6), but for those that continue their surroundings. What
/// is hidden from the right view, whose disparity `other` is, stays unknown.
void replace_doubtful(Image<float>& disparity, const Image<float>& other, const Image<std::uint8_t>& distinct,
                      const DisparityRange& range);

}  // namespace wheatstone
