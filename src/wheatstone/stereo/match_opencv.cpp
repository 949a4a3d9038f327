#include <algorithm>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/stereo/match_internal.h"

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

}  // namespace

Image<float> match_with_opencv(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range,
                               const MatchOptions& options) {
  // OpenCV finds nothing in the columns whose counterparts may lie outside, and is neither safe nor repeatable where
  // they are most of the picture. Repeated edge pixels on both sides keep all of ours clear of them.
  const int reach = std::max(std::abs(range.least), std::abs(range.least + disparity_count(range)));
  const int margin = reach + 2 * options.block_px;
  cv::Mat wide_own, wide_other;
  cv::copyMakeBorder(own, wide_own, 0, 0, margin, margin, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(other, wide_other, 0, 0, margin, margin, cv::BORDER_REPLICATE);

  cv::Ptr<cv::StereoMatcher> matcher;
  if (options.matcher == Matcher::bm) {
    matcher = make_bm(range, options.block_px);
    cv::cvtColor(wide_own, wide_own, cv::COLOR_RGB2GRAY);
    cv::cvtColor(wide_other, wide_other, cv::COLOR_RGB2GRAY);
  } else {
    matcher = make_sgbm(range, options.block_px);
  }
  cv::Mat sixteenths;
  matcher->compute(wide_own, wide_other, sixteenths);

  Image<float> disparity(own.cols, own.rows);
  const int least = range.least * sixteenths_a_px;
  for (int y = 0; y < own.rows; ++y) {
    const auto* from = sixteenths.ptr<std::int16_t>(y) + margin;
    const auto to = disparity.row(y);
    for (int x = 0; x < own.cols; ++x)
      to[x] = from[x] < least ? std::numeric_limits<float>::quiet_NaN()
                              : static_cast<float>(from[x]) / sixteenths_a_px;
  }
  return disparity;
}

}  // namespace wheatstone
