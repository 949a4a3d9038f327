#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/matching/semi_global_internal.h"

namespace wheatstone {

/// Where a match can be trusted and where not; masks of the left picture, 255 or 0.
struct TrustedPlaces {
  /// Large parts that show nothing but noise and match at no disparity better than at others, up to the edges around: a
  /// white ground, a clear sky. What is found there is chance, or was carried there from an edge.
  cv::Mat plain;
  /// The surroundings of a pixel match at its disparity clearly better than at others of its band.
  cv::Mat distinct;
  /// One colour, without even noise: every disparity fits.
  cv::Mat blank;
};

/// `picture` is the left one, 8-bit RGB.
TrustedPlaces trusted_places(const cv::Mat& picture, const BandMatch& match);

}  // namespace wheatstone
