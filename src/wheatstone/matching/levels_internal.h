#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "wheatstone/matching/match.h"
#include "wheatstone/matching/semi_global_internal.h"

namespace wheatstone {

/// Two 8-bit RGB pictures of one size that are compared.
struct Level {
  cv::Mat left, right;
};

/// The pair at its own size first, the right picture exposed as the left one; then copies, each half as large as the
/// one before, until the whole range can be looked through in the last, which has at most this share of the width.
std::vector<Level> levels_of(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                             double most_scale = 1);

/// The right picture with the left one's exposure and colour, told from the means and spreads of their channels; as it
/// is where these are nearly equal.
cv::Mat exposed_alike(const cv::Mat& left, const cv::Mat& right);

/// The whole range in a copy of this share of the pictures' width.
SearchBand whole_range(const Level& level, double scale, const DisparityRange& range);

/// The disparities looked at around what is known, or expected, everywhere.
SearchBand band_around(const Image<float>& disparity);

}  // namespace wheatstone
