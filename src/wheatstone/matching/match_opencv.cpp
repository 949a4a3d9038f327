#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/plain_sgbm_opencv.h"

namespace wheatstone {
namespace {

/// OpenCV counts disparities in sixteens.
int disparity_count(const DisparityRange& range) { return (range.largest - range.least + 16) / 16 * 16; }

cv::Ptr<cv::StereoMatcher> make_sgbm(const DisparityRange& range, int block_px) {
  const int area = 3 * block_px * block_px;
  constexpr int disparity_difference = -1;  // ours is made both ways, below
  constexpr int pre_filter_cap = 63, uniqueness_percent = 5;
  return cv::StereoSGBM::create(range.least, disparity_count(range), block_px, 8 * area, 32 * area,
                                disparity_difference, pre_filter_cap, uniqueness_percent, 0, 0,
                                cv::StereoSGBM::MODE_SGBM_3WAY);
}

cv::Ptr<cv::StereoMatcher> make_bm(const DisparityRange& range, int block_px) {
  constexpr int least_block_px = 11;
  const auto matcher = cv::StereoBM::create(disparity_count(range), std::max(block_px, least_block_px));
  matcher->setMinDisparity(range.least);
  matcher->setUniquenessRatio(10);
  matcher->setTextureThreshold(10);
  return matcher;
}

/// Runs a matcher and reads its result. OpenCV finds nothing in the columns whose counterparts may lie outside, and is
/// neither safe nor repeatable where they are most of the picture. Repeated edge pixels on both sides keep all of ours
/// clear of them. Its filter of speckles counts the pixels of a side in 16 bits, and writes elsewhere beyond that: ours
/// takes its place.
Image<float> run(cv::StereoMatcher& matcher, const cv::Mat& own, const cv::Mat& other) {
  const int least = matcher.getMinDisparity(), largest = least + matcher.getNumDisparities();
  const int margin = std::max(std::abs(least), std::abs(largest)) + 2 * matcher.getBlockSize();
  cv::Mat wide_own, wide_other, sixteenths;
  cv::copyMakeBorder(own, wide_own, 0, 0, margin, margin, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(other, wide_other, 0, 0, margin, margin, cv::BORDER_REPLICATE);
  constexpr int most_side_px = 32766;
  const int own_speckle_px = std::max(wide_own.cols, wide_own.rows) > most_side_px ? matcher.getSpeckleWindowSize() : 0;
  if (own_speckle_px > 0) matcher.setSpeckleWindowSize(0);
  matcher.compute(wide_own, wide_other, sixteenths);

  Image<float> disparity(own.cols, own.rows);
  for (int y = 0; y < own.rows; ++y) {
    const auto* from = sixteenths.ptr<std::int16_t>(y) + margin;
    const auto to = disparity.row(y);
    for (int x = 0; x < own.cols; ++x)
      to[x] = from[x] < least * sixteenths_a_px ? std::numeric_limits<float>::quiet_NaN()
                                                : static_cast<float>(from[x]) / sixteenths_a_px;
  }
  if (own_speckle_px > 0) remove_speckles(disparity, own_speckle_px);
  return disparity;
}

}  // namespace

Image<float> match_with_opencv(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range,
                               const MatchOptions& options) {
  if (options.matcher == Matcher::sgbm) return run(*make_sgbm(range, options.block_px), own, other);
  cv::Mat own_luminance, other_luminance;
  cv::cvtColor(own, own_luminance, cv::COLOR_RGB2GRAY);
  cv::cvtColor(other, other_luminance, cv::COLOR_RGB2GRAY);
  return run(*make_bm(range, options.block_px), own_luminance, other_luminance);
}

Image<float> match_plain_sgbm(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range) {
  constexpr int block_px = 5, area = 3 * block_px * block_px;
  constexpr int left_right_px = 1, pre_filter_cap = 63, uniqueness_percent = 10, speckle_px = 100, speckle_range = 2;
  const auto matcher = cv::StereoSGBM::create(range.least, disparity_count(range), block_px, 8 * area, 32 * area,
                                              left_right_px, pre_filter_cap, uniqueness_percent, speckle_px,
                                              speckle_range, cv::StereoSGBM::MODE_SGBM_3WAY);
  return run(*matcher, own, other);
}

}  // namespace wheatstone
