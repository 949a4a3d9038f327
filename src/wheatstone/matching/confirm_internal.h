#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "wheatstone/image/image.h"
#include "wheatstone/matching/match.h"

namespace wheatstone {

/// What the other view's disparity agrees with, within a tolerance; NaN elsewhere. `sign` is −1 where `own` is the left
/// view and 1 where it is the right one.
Image<float> confirmed_disparity(const Image<float>& own, const Image<float>& other, float sign, float tolerance_px);

/// True where the right view holds nothing that could be column x of the left one: no disparity of the range leads to a
/// pixel with the same one, to within a pixel. `right` is a row of its disparities.
bool is_hidden_from(std::span<const float> right, int x, const DisparityRange& range);

/// As OpenCV's filters take it: CV_16S, sixteenths of a pixel.
inline constexpr int unknown_sixteenths = -32768;
cv::Mat in_sixteenths(const Image<float>& disparity, float sign);

/// Makes connected patches of like disparity unknown that have fewer than this many pixels.
void remove_speckles(Image<float>& disparity, int least_surface_px);

/// As remove_speckles, but keeps what may be seen through a hole: 40 pixels or more that are farther than what is on
/// either side, and no farther than something larger nearby.
void remove_speckles_but_holes(Image<float>& disparity, int least_surface_px);

/// 255 where a 32-bit disparity is NaN. Not `disparity != disparity`, which OpenCV 4.6 takes for false where it
/// compares vectors.
cv::Mat unknown_places(const cv::Mat& disparity);

/// The share of pixels, 0..1, whose disparity is known.
double known_share(const Image<float>& disparity);

}  // namespace wheatstone
