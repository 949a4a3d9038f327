#include "wheatstone/matching/fill_in_picture_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/ximgproc/edge_filter.hpp>
#include <vector>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

struct Ends {
  float least = 0, largest = 0;
};

Ends ends_of(const Image<float>& disparity) {
  Ends range{INFINITY, -INFINITY};
  for (const float d : disparity.pixels()) {
    if (!std::isfinite(d)) continue;
    range.least = std::min(range.least, d);
    range.largest = std::max(range.largest, d);
  }
  return range;
}

/// Pixels whose partners would lie beside the right picture have one known neighbour only, to their right, and what it
/// tells varies from row to row: they take the median of the rows around.
void steady_border(const Image<float>& known, Image<float>& filled) {
  constexpr int rows_around = 9;
  const Image<float> before = filled;
  const auto outside = [&](int x, int y) {
    return !std::isfinite(known(x, y)) && static_cast<float>(x) < before(x, y);
  };
  tbb::parallel_for(0, known.height(), [&](int y) {
    std::vector<float> around;
    for (int x = 0; x < known.width() && !std::isfinite(known(x, y)); ++x) {
      if (!outside(x, y)) continue;
      around.clear();
      for (int j = std::max(y - rows_around, 0); j <= std::min(y + rows_around, known.height() - 1); ++j)
        around.push_back(before(x, j));
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
      std::ranges::nth_element(around, middle);
      filled(x, y) = *middle;
    }
  });
}

}  // namespace

void fill_in_picture(Image<float>& disparity, const Image<float>& other, const cv::Mat& picture) {
  const int width = disparity.width(), height = disparity.height();
  Image<float> farther = disparity;
  fill_from_farther_side(farther);
  steady_border(disparity, farther);
  const Ends ends = ends_of(disparity);
  const DisparityRange range{static_cast<int>(std::floor(ends.least)), static_cast<int>(std::ceil(ends.largest))};

  // The solver's data: what is known, and what is hidden with less confidence.
  constexpr float hidden_confidence = 0.5f;
  cv::Mat weighted(height, width, CV_32F), confidence(height, width, CV_32F);
  tbb::parallel_for(0, height, [&](int y) {
    auto* value = weighted.ptr<float>(y);
    auto* weight = confidence.ptr<float>(y);
    for (int x = 0; x < width; ++x) {
      const bool known = std::isfinite(disparity(x, y));
      weight[x] = known ? 1.f : is_hidden_from(other.row(y), x, range) ? hidden_confidence : 0.f;
      value[x] = weight[x] * (farther(x, y) - ends.least);
    }
  });
  constexpr double smoothness = 4000, colour_sigma = 4;
  cv::Mat spread_values, spread_confidence;
  cv::ximgproc::fastGlobalSmootherFilter(picture, weighted, spread_values, smoothness, colour_sigma);
  cv::ximgproc::fastGlobalSmootherFilter(picture, confidence, spread_confidence, smoothness, colour_sigma);
  tbb::parallel_for(0, height, [&](int y) {
    const auto* value = spread_values.ptr<float>(y);
    const auto* weight = spread_confidence.ptr<float>(y);
    const auto* given = confidence.ptr<float>(y);
    constexpr float least_confidence = 1e-4f;
    for (int x = 0; x < width; ++x) {
      if (std::isfinite(disparity(x, y))) continue;
      const bool spread = given[x] == 0 && weight[x] > least_confidence;
      disparity(x, y) =
          spread ? std::clamp(ends.least + value[x] / weight[x], ends.least, ends.largest) : farther(x, y);
    }
  });
}

}  // namespace wheatstone
