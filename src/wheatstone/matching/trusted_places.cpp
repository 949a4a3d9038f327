#include "wheatstone/matching/trusted_places_internal.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

/// The cost at the disparity that was chosen, as a share of the mean of all: near 1 where none is better than another.
cv::Mat cost_share(const BandMatch& match) {
  constexpr int window_px = 9;
  cv::Mat own, mean;
  cv::boxFilter(as_mat(match.own_cost), own, CV_32F, {window_px, window_px});
  cv::boxFilter(as_mat(match.mean_cost), mean, CV_32F, {window_px, window_px});
  return own / (mean + 0.01f);
}

/// The deviation in the plainest parts of a picture: its noise, where it has any plain part.
float noise_of(const cv::Mat& deviation) {
  constexpr double plainest = 0.1, sampled = 0.25;
  cv::Mat small;
  cv::resize(deviation, small, {}, sampled, sampled, cv::INTER_NEAREST);
  std::vector<float> values(small.begin<float>(), small.end<float>());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(plainest * static_cast<double>(values.size()));
  std::ranges::nth_element(values, at);
  return *at;
}

/// Grey levels' deviation in a window around each pixel.
cv::Mat deviation_of(const cv::Mat& picture, cv::Size window) {
  cv::Mat grey, mean, mean_square, deviation;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  cv::boxFilter(grey, mean, CV_32F, window);
  cv::sqrBoxFilter(grey, mean_square, CV_32F, window);
  cv::sqrt(cv::max(mean_square - mean.mul(mean), 0), deviation);
  return deviation;
}

}  // namespace

cv::Mat plain_places(const cv::Mat& picture, const BandMatch& match) {
  constexpr float above_noise = 1.6f, least_limit = 1.2f, largest_limit = 3;
  constexpr double no_better = 0.6;
  const cv::Size window(7, 7);
  const cv::Mat deviation = deviation_of(picture, window);
  const float limit = std::clamp(above_noise * noise_of(deviation), least_limit, largest_limit);
  cv::Mat plain = (deviation < limit) & (cost_share(match) > no_better);

  // Small plain places are carried by what surrounds them; large ones are not.
  constexpr int large_share = 8;  // of the width
  constexpr double mostly = 0.8 * 255;
  const int large_px = std::max(picture.cols / large_share, window.width) | 1;
  cv::Mat large;
  cv::boxFilter(plain, large, -1, {large_px, large_px});
  large = large > mostly;
  cv::dilate(large, large, cv::getStructuringElement(cv::MORPH_RECT, {large_px, large_px}));
  plain &= large;
  cv::dilate(plain, plain, cv::getStructuringElement(cv::MORPH_RECT, window));
  return plain;
}

cv::Mat distinct_places(const BandMatch& match) {
  constexpr double clearly_better = 0.7;
  return cost_share(match) < clearly_better;
}

}  // namespace wheatstone
