#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// A pair matched at its own size.
struct CheckedMatch {
  Image<float> left;   ///< every pixel known; what was not found is filled
  Image<float> found;  ///< the same, NaN where the right view does not confirm it
  Image<float> right;  ///< as the right view sees it; NaN where unknown
};

/// Matches two 8-bit RGB pictures of one size semi-globally: over the whole range in copies so small that noise and
/// compression do not decide, then at twice the size each time, near what the coarser copies had, up to the pictures'
/// own size. Memory and time grow with the number of pixels. Throws Error{bad_input} where nothing is found.
CheckedMatch match_coarse_to_fine(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                                  const MatchOptions& options, const Progress& progress = {});

}  // namespace wheatstone
