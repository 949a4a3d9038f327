#include "wheatstone/matching/weighted_median_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

struct WeightedDisparity {
  float disparity;
  int weight;
};

/// Weights by the sum of the channels' differences.
std::array<int, 3 * 255 + 1> weights_by_distance() {
  constexpr double like_colour = 30;
  std::array<int, 3 * 255 + 1> weights{};
  for (std::size_t distance = 0; distance < weights.size(); ++distance)
    weights[distance] = static_cast<int>(std::lround(4096 * std::exp(-static_cast<double>(distance) / like_colour)));
  return weights;
}

float median_of(std::vector<WeightedDisparity>& samples) {
  std::ranges::sort(samples, {}, &WeightedDisparity::disparity);
  int all = 0, below = 0;
  for (const WeightedDisparity& sample : samples) all += sample.weight;
  for (const WeightedDisparity& sample : samples) {
    below += sample.weight;
    if (2 * below >= all) return sample.disparity;
  }
  return samples.back().disparity;
}

}  // namespace

Image<float> weighted_median(const Image<float>& disparity, const cv::Mat& picture,
                             const WeightedMedianOptions& options) {
  const int width = disparity.width(), height = disparity.height(), radius = options.radius_px;
  static const std::array<int, 3 * 255 + 1> weights = weights_by_distance();
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1});
  cv::Mat least, largest;
  cv::erode(as_mat(disparity), least, window);
  cv::dilate(as_mat(disparity), largest, window);
  // A pixel of 1000; less is no edge.
  const float least_step = std::max(1.f, static_cast<float>(width) / 1000);
  Image<float> result = disparity;
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<WeightedDisparity> samples;
    const auto* own = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < width; ++x) {
      if (largest.at<float>(y, x) - least.at<float>(y, x) <= least_step) continue;
      samples.clear();
      for (int down = -radius; down <= radius; down += options.step_px) {
        const int j = std::clamp(y + down, 0, height - 1);
        const auto row = disparity.row(j);
        const auto* colours = picture.ptr<cv::Vec3b>(j);
        for (int across = -radius; across <= radius; across += options.step_px) {
          const int i = std::clamp(x + across, 0, width - 1);
          const int distance = std::abs(own[x][0] - colours[i][0]) + std::abs(own[x][1] - colours[i][1]) +
                               std::abs(own[x][2] - colours[i][2]);
          samples.push_back({row[i], weights[distance]});
        }
      }
      result(x, y) = median_of(samples);
    }
  });
  return result;
}

}  // namespace wheatstone
