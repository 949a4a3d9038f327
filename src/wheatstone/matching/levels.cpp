#include "wheatstone/matching/levels_internal.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace wheatstone {
namespace {

/// The coarsest copies are at most this wide, and have at most this many costs.
constexpr int coarsest_width_px = 900;
constexpr double most_coarse_costs = 80e6;
/// Disparities looked at around what the coarser copy had.
constexpr int fine_count = 16;

double coarsest_scale(cv::Size size, const DisparityRange& range) {
  const double count = static_cast<double>(range.largest) - range.least + 1;
  const double costs = static_cast<double>(size.area()) * count;
  return std::min({1.0, static_cast<double>(coarsest_width_px) / size.width, std::cbrt(most_coarse_costs / costs)});
}

}  // namespace

std::vector<Level> levels_of(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                             double most_scale) {
  const double coarsest = std::min(coarsest_scale(left.size(), range), most_scale);
  std::vector<Level> levels{{left, exposed_alike(left, right)}};
  while (static_cast<double>(levels.back().left.cols) > left.cols * coarsest * 1.001) {
    const Level& larger = levels.back();
    const cv::Size size((larger.left.cols + 1) / 2, (larger.left.rows + 1) / 2);
    Level smaller;
    tbb::parallel_invoke([&] { cv::resize(larger.left, smaller.left, size, 0, 0, cv::INTER_AREA); },
                         [&] { cv::resize(larger.right, smaller.right, size, 0, 0, cv::INTER_AREA); });
    levels.push_back(std::move(smaller));
  }
  return levels;
}

cv::Mat exposed_alike(const cv::Mat& left, const cv::Mat& right) {
  cv::Scalar left_mean, left_spread, right_mean, right_spread;
  tbb::parallel_invoke([&] { cv::meanStdDev(left, left_mean, left_spread); },
                       [&] { cv::meanStdDev(right, right_mean, right_spread); });
  constexpr double least_spread = 1, near_gain = 0.03, near_mean = 3;
  bool alike = true;
  std::array<double, 3> gain{};
  for (int channel = 0; channel < 3; ++channel) {
    gain[channel] = std::max(left_spread[channel], least_spread) / std::max(right_spread[channel], least_spread);
    alike = alike && std::abs(gain[channel] - 1) <= near_gain &&
            std::abs(left_mean[channel] - right_mean[channel]) <= near_mean;
  }
  if (alike) return right;
  cv::Mat table(1, 256, CV_8UC3), result;
  for (int code = 0; code < 256; ++code)
    for (int channel = 0; channel < 3; ++channel)
      table.at<cv::Vec3b>(code)[channel] =
          cv::saturate_cast<std::uint8_t>(gain[channel] * (code - right_mean[channel]) + left_mean[channel]);
  cv::LUT(right, table, result);
  return result;
}

SearchBand whole_range(const Level& level, double scale, const DisparityRange& range) {
  const int least = static_cast<int>(std::floor(range.least * scale)),
            largest = static_cast<int>(std::ceil(range.largest * scale));
  return {Image<std::int16_t>(level.left.cols, level.left.rows, static_cast<std::int16_t>(least)), largest - least + 1};
}

SearchBand band_around(const Image<float>& disparity) {
  constexpr int half_band = fine_count / 2;
  SearchBand band{Image<std::int16_t>(disparity.width(), disparity.height()), fine_count};
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    std::ranges::transform(disparity.row(y), band.first.row(y).begin(),
                           [](float d) { return static_cast<std::int16_t>(std::floor(d + 0.5f) - half_band); });
  });
  return band;
}

}  // namespace wheatstone
