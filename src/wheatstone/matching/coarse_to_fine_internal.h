#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// A pair matched at its own size.
struct CheckedMatch {
  Image<float> left;   ///< every pixel known; what was not found is filled
  Image<float> found;  ///< the same, NaN where it is not to be trusted: not confirmed by the right view, or chance
  Image<float> right;  ///< as the right view sees it; NaN where unknown
  cv::Mat confirmed;  ///< 255 where the right view confirms the left one's disparity within the tolerance, be it chance
  cv::Mat plain;      ///< 255 where the picture is plain; empty: not looked for
};

/// Matches two 8-bit RGB pictures of one size semi-globally: over the whole range in copies so small that noise and
/// compression do not decide, then at twice the size each time, near what the coarser copies had, up to the pictures'
/// own size. Memory and time grow with the number of pixels. Throws Error{bad_input} where nothing is found.
CheckedMatch match_coarse_to_fine(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                                  const MatchOptions& options, const Progress& progress = {});

/// Finds parts of a pixel in copies of twice the size, within a pixel of a disparity that is known everywhere and only
/// where the right view confirms them. Two 8-bit RGB pictures of one size.
void refine_at_double_size(const cv::Mat& left, const cv::Mat& right, Image<float>& disparity);

}  // namespace wheatstone
