#include "wheatstone/matching/fill_in_picture_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
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

/// What one row's neighbours tell varies from row to row: unknown pixels take the median of those above and below that
/// are unknown too.
void steady_rows(const Image<float>& known, Image<float>& filled) {
  constexpr int rows_around = 9;
  const Image<float> before = filled;
  const int height = known.height();
  tbb::parallel_for(0, known.width(), [&](int x) {
    std::vector<float> around;
    for (int y = 0; y < height; ++y) {
      if (std::isfinite(known(x, y))) continue;
      around.clear();
      for (int j = y; j >= std::max(y - rows_around, 0) && !std::isfinite(known(x, j)); --j)
        around.push_back(before(x, j));
      for (int j = y + 1; j <= std::min(y + rows_around, height - 1) && !std::isfinite(known(x, j)); ++j)
        around.push_back(before(x, j));
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
      std::ranges::nth_element(around, middle);
      filled(x, y) = *middle;
    }
  });
}

/// Values with confidences, and both multiplied.
struct Weighted {
  cv::Mat product, confidence;
};

/// What joins each pixel to the next one of its row, and of its column: exp(−|colour difference| / σ), and 0 at the
/// end.
struct EdgeWeights {
  cv::Mat across, down;
};

EdgeWeights edge_weights(const cv::Mat& picture, double colour_sigma) {
  EdgeWeights weights{cv::Mat(picture.size(), CV_32F), cv::Mat(picture.cols, picture.rows, CV_32F)};
  const auto alike = [&](const cv::Vec3b& a, const cv::Vec3b& b) {
    const int red = a[0] - b[0], green = a[1] - b[1], blue = a[2] - b[2];
    return static_cast<float>(std::exp(-std::sqrt(red * red + green * green + blue * blue) / colour_sigma));
  };
  tbb::parallel_for(0, picture.rows, [&](int y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto& own = picture.at<cv::Vec3b>(y, x);
      weights.across.at<float>(y, x) = x + 1 < picture.cols ? alike(own, picture.at<cv::Vec3b>(y, x + 1)) : 0;
      weights.down.at<float>(x, y) = y + 1 < picture.rows ? alike(own, picture.at<cv::Vec3b>(y + 1, x)) : 0;
    }
  });
  return weights;
}

/// Weighted least squares along each row: a tridiagonal system (Min et al. 2014, eq. 7).
void smooth_rows(cv::Mat& values, const cv::Mat& weights, float smoothness) {
  tbb::parallel_for(0, values.rows, [&](int y) {
    auto* value = values.ptr<float>(y);
    const auto* weight = weights.ptr<float>(y);
    std::vector<float> share(values.cols);
    float before = 0, share_before = 0, value_before = 0;
    for (int x = 0; x < values.cols; ++x) {
      const float after = smoothness * weight[x], pivot = 1 + before + after - share_before * before;
      share[x] = share_before = after / pivot;
      value[x] = value_before = (value[x] + before * value_before) / pivot;
      before = after;
    }
    for (int x = values.cols - 2; x >= 0; --x) value[x] += share[x] * value[x + 1];
  });
}

/// The fast global smoother of Min et al. 2014. OpenCV's gives other last digits on other numbers of threads.
cv::Mat smoothed(const cv::Mat& values, const EdgeWeights& weights, double smoothness) {
  constexpr int rounds = 3;
  constexpr float attenuation = 0.25f;
  cv::Mat rows = values.clone(), columns;
  auto strength = static_cast<float>(smoothness);
  for (int round = 0; round < rounds; ++round, strength *= attenuation) {
    smooth_rows(rows, weights.across, strength);
    cv::transpose(rows, columns);
    smooth_rows(columns, weights.down, strength);
    cv::transpose(columns, rows);
  }
  return rows;
}

Weighted spread(const cv::Mat& picture, const Weighted& from, double smoothness, double colour_sigma) {
  const EdgeWeights weights = edge_weights(picture, colour_sigma);
  return {smoothed(from.product, weights, smoothness), smoothed(from.confidence, weights, smoothness)};
}

/// The farther of the surfaces around each pixel, from far and wide: what is nearer counts less.
cv::Mat farther_around(const cv::Mat& picture, const Weighted& known, double range) {
  constexpr double smoothness = 1e5, colour_sigma = 40, least = 1e-20;
  const double near_share = 0.1 * std::max(range, 1.0);
  cv::Mat value, weight;
  cv::divide(known.product, cv::max(known.confidence, least), value);
  cv::exp(value * (-1 / near_share), weight);
  Weighted biased;
  biased.confidence = weight.mul(known.confidence);
  biased.product = value.mul(biased.confidence);
  const Weighted around = spread(picture, biased, smoothness, colour_sigma);
  return around.product / cv::max(around.confidence, least);
}

}  // namespace

void fill_in_picture(Image<float>& disparity, const Image<float>& other, const PictureToFill& by) {
  const int width = disparity.width(), height = disparity.height();
  Image<float> farther = disparity;
  fill_from_farther_side(farther);
  steady_rows(disparity, farther);
  const Ends ends = ends_of(disparity);
  const DisparityRange range{static_cast<int>(std::floor(ends.least)), static_cast<int>(std::ceil(ends.largest))};

  // The solver's data: what is known, and what is hidden with less confidence.
  constexpr float hidden_confidence = 0.5f;
  Weighted data{cv::Mat(height, width, CV_32F), cv::Mat(height, width, CV_32F)};
  tbb::parallel_for(0, height, [&](int y) {
    auto* product = data.product.ptr<float>(y);
    auto* weight = data.confidence.ptr<float>(y);
    const auto* plain = by.plain.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) {
      const bool known = std::isfinite(disparity(x, y));
      const bool hidden = !known && plain[x] == 0 && is_hidden_from(other.row(y), x, range);
      weight[x] = known ? 1.f : hidden ? hidden_confidence : 0.f;
      product[x] = weight[x] * (farther(x, y) - ends.least);
    }
  });
  constexpr double smoothness = 4000, colour_sigma = 4;
  const Weighted around = spread(by.picture, data, smoothness, colour_sigma);
  const cv::Mat far = farther_around(by.picture, data, ends.largest - ends.least);
  tbb::parallel_for(0, height, [&](int y) {
    const auto* product = around.product.ptr<float>(y);
    const auto* weight = around.confidence.ptr<float>(y);
    const auto* given = data.confidence.ptr<float>(y);
    const auto* plain = by.plain.ptr<std::uint8_t>(y);
    const auto* far_value = far.ptr<float>(y);
    constexpr float least_confidence = 1e-4f, far_confidence = 1;
    for (int x = 0; x < width; ++x) {
      if (std::isfinite(disparity(x, y))) continue;
      const float prior = plain[x] != 0 ? far_confidence : 0.f;
      const float confidence = weight[x] + prior;
      disparity(x, y) =
          given[x] > 0 || confidence <= least_confidence
              ? farther(x, y)
              : std::clamp(ends.least + (product[x] + prior * far_value[x]) / confidence, ends.least, ends.largest);
    }
  });
}

}  // namespace wheatstone
