#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// The disparities that each pixel of the left picture may take: `count` whole ones from `first(x, y)` on.
struct SearchBand {
  Image<std::int16_t> first;
  int count = 0;
};

/// Disparities of both pictures, each in its own geometry, as they were found: nothing is checked. NaN in the right
/// picture where no pixel of the left one could lead.
struct BandMatch {
  Image<float> left, right;
  /// Of the left picture's pixels: the cost at the disparity that was chosen, and the mean of its band.
  Image<std::uint8_t> own_cost, mean_cost;
};

/// Semi-global matching along eight paths (Hirschmüller 2008) of two 8-bit RGB pictures of one size. What is compared
/// is the census of 9×7 pixels (Zabih & Woodfill 1994), which unlike exposures and noise leave alone, and colours
/// between pixels (Birchfield & Tomasi 1998), which keep depth edges sharp. The band may differ from pixel to pixel, as
/// in Rothermel et al. 2012 (SURE). Large pictures are matched in strips of rows that overlap. The same result on any
/// number of threads.
BandMatch match_semi_global(const cv::Mat& left, const cv::Mat& right, const SearchBand& band);

}  // namespace wheatstone
