#include "wheatstone/measures/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/plain_sgbm_opencv.h"

namespace wheatstone {
namespace {

void check_one_size(const StereoPairView& pair, ImageView<const float> left_disparity) {
  if (same_size(pair.left, pair.right) && same_size(pair.left, left_disparity)) return;
  throw Error(ErrorKind::bad_input,
              fmt::format("measured pictures of {}x{} and {}x{} pixels with a disparity of {}x{}, expected one size",
                          pair.left.width(), pair.left.height(), pair.right.width(), pair.right.height(),
                          left_disparity.width(), left_disparity.height()));
}

/// From nothing, or the truth's least, to its largest, in whole pixels; no farther than the picture is wide.
DisparityRange range_of(ImageView<const float> disparity) {
  const auto [least, largest] = range_with_zero(disparity);
  const auto width = static_cast<float>(disparity.width());
  return {static_cast<int>(std::floor(std::max(least, -width))), static_cast<int>(std::ceil(std::min(largest, width)))};
}

}  // namespace

Image<std::uint8_t> visible_in_both(ImageView<const float> left_disparity) {
  constexpr float tolerance_px = 1;
  const int width = left_disparity.width();
  Image<std::uint8_t> visible(width, left_disparity.height());
  std::vector<float> nearest(width);
  for (int y = 0; y < visible.height(); ++y) {
    const auto disparity = left_disparity.row(y);
    const auto target = [&](int x) {  // pixel of the right view; −1 where there is none
      const float place = static_cast<float>(x) + 0.5f - disparity[x];
      return place >= 0 && place < static_cast<float>(width) ? static_cast<int>(place) : -1;
    };
    std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
    for (int x = 0; x < width; ++x)
      if (const int there = target(x); there >= 0) nearest[there] = std::max(nearest[there], disparity[x]);
    for (int x = 0; x < width; ++x)
      if (const int there = target(x); there >= 0 && nearest[there] <= disparity[x] + tolerance_px) visible(x, y) = 255;
  }
  return visible;
}

LeftRightDifference measure_left_right_difference(const StereoPairView& pair, ImageView<const float> left_disparity) {
  check_one_size(pair, left_disparity);
  const int width = pair.left.width(), height = pair.left.height();
  const Image<std::uint8_t> visible = visible_in_both(left_disparity);
  double absolute = 0, squared = 0;
  std::size_t compared = 0;
  for (int y = 0; y < height; ++y) {
    const auto left = pair.left.row(y), right = pair.right.row(y);
    for (int x = 0; x < width; ++x) {
      if (visible(x, y) == 0) continue;
      const float place = std::clamp(static_cast<float>(x) - left_disparity(x, y), 0.f, static_cast<float>(width - 1));
      const int before = static_cast<int>(place), after = std::min(before + 1, width - 1);
      const float t = place - static_cast<float>(before);
      const auto add = [&](std::uint8_t Rgb8::*channel) {
        const float there =
            (1 - t) * static_cast<float>(right[before].*channel) + t * static_cast<float>(right[after].*channel);
        const double difference = static_cast<double>(left[x].*channel) - there;
        absolute += std::abs(difference);
        squared += difference * difference;
      };
      add(&Rgb8::r);
      add(&Rgb8::g);
      add(&Rgb8::b);
      ++compared;
    }
  }
  LeftRightDifference result;
  if (compared == 0) return result;
  const double samples = 3 * static_cast<double>(compared);
  result.mean_absolute = absolute / samples;
  result.rmse = std::sqrt(squared / samples) / 255;
  result.compared_share = static_cast<double>(compared) / (static_cast<double>(width) * height);
  return result;
}

double gradient_energy(ImageView<const Rgb8> picture) {
  cv::Mat luminance, gradient_x, gradient_y;
  cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
  constexpr double sobel_scale = 1.0 / 8;
  cv::Sobel(luminance, gradient_x, CV_32F, 1, 0, 3, sobel_scale);
  cv::Sobel(luminance, gradient_y, CV_32F, 0, 1, 3, sobel_scale);
  return (cv::norm(gradient_x, cv::NORM_L2SQR) + cv::norm(gradient_y, cv::NORM_L2SQR)) /
         static_cast<double>(luminance.total());
}

DepthSurvival measure_depth_survival(const StereoPair& pair, ImageView<const float> left_disparity) {
  check_one_size(pair, left_disparity);
  const Image<float> found = match_plain_sgbm(as_mat(pair.left), as_mat(pair.right), range_of(left_disparity));
  const Image<std::uint8_t> visible = visible_in_both(left_disparity);
  std::size_t asked = 0, matched = 0, within_1 = 0, within_2 = 0;
  double error_sum = 0;
  for (int y = 0; y < visible.height(); ++y) {
    for (int x = 0; x < visible.width(); ++x) {
      if (visible(x, y) == 0) continue;
      ++asked;
      if (!std::isfinite(found(x, y))) continue;
      ++matched;
      const double error = std::abs(found(x, y) - left_disparity(x, y));
      error_sum += error;
      within_1 += error <= 1 ? 1 : 0;
      within_2 += error <= 2 ? 1 : 0;
    }
  }
  DepthSurvival survival;
  if (asked == 0) return survival;
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(asked); };
  survival.density = share(matched);
  survival.bad_1 = 1 - share(within_1);
  survival.bad_2 = 1 - share(within_2);
  survival.end_point_error = matched > 0 ? error_sum / static_cast<double>(matched) : 0;
  return survival;
}

}  // namespace wheatstone
