#include "wheatstone/matching/coarse_to_fine_internal.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/fill_in_picture_internal.h"
#include "wheatstone/matching/semi_global_internal.h"

namespace wheatstone {
namespace {

/// The coarsest copies are at most this wide, and have at most this many costs.
constexpr int coarsest_width_px = 900;
constexpr double most_coarse_costs = 80e6;
/// Disparities looked at around what the coarser copy had.
constexpr int fine_count = 12;

struct Level {
  cv::Mat left, right;
};

double coarsest_scale(cv::Size size, const DisparityRange& range) {
  const double count = static_cast<double>(range.largest) - range.least + 1;
  const double costs = static_cast<double>(size.area()) * count;
  return std::min({1.0, static_cast<double>(coarsest_width_px) / size.width, std::cbrt(most_coarse_costs / costs)});
}

/// The pair at its own size first, each copy half as large as the one before, until it is small enough.
std::vector<Level> levels_of(const cv::Mat& left, const cv::Mat& right, double coarsest) {
  std::vector<Level> levels{{left, right}};
  while (static_cast<double>(levels.back().left.cols) > left.cols * coarsest * 1.001) {
    const Level& larger = levels.back();
    const cv::Size size((larger.left.cols + 1) / 2, (larger.left.rows + 1) / 2);
    Level smaller;
    cv::resize(larger.left, smaller.left, size, 0, 0, cv::INTER_AREA);
    cv::resize(larger.right, smaller.right, size, 0, 0, cv::INTER_AREA);
    levels.push_back(std::move(smaller));
  }
  return levels;
}

/// The right picture with the left one's exposure and colour, told from the means and spreads of their channels; as it
/// is where these are nearly equal.
cv::Mat exposed_alike(const cv::Mat& left, const cv::Mat& right) {
  cv::Scalar left_mean, left_spread, right_mean, right_spread;
  cv::meanStdDev(left, left_mean, left_spread);
  cv::meanStdDev(right, right_mean, right_spread);
  constexpr double least_spread = 1, near_gain = 0.03, near_mean = 3;
  bool alike = true;
  std::array<double, 3> gain{};
  for (int channel = 0; channel < 3; ++channel) {
    gain[channel] = std::max(left_spread[channel], least_spread) / std::max(right_spread[channel], least_spread);
    alike = alike && std::abs(gain[channel] - 1) <= near_gain &&
            std::abs(left_mean[channel] - right_mean[channel]) <= near_mean;
  }
  if (alike) return right;
  std::vector<cv::Mat> channels;
  cv::split(right, channels);
  for (int channel = 0; channel < 3; ++channel)
    channels[channel].convertTo(channels[channel], -1, gain[channel],
                                left_mean[channel] - gain[channel] * right_mean[channel]);
  cv::Mat result;
  cv::merge(channels, result);
  return result;
}

/// The colour distance of two pixels, 0..765.
int colour_distance(const cv::Vec3b& a, const cv::Vec3b& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/// The disparity of a copy of half the size at this one's: each pixel takes that of the coarser pixel around it whose
/// colour is most like its own, so that depth edges follow the picture's.
Image<float> enlarged_along_edges(const Image<float>& coarse, const Level& coarse_level, const Level& level) {
  const int width = level.left.cols, height = level.left.rows;
  Image<float> result(width, height);
  const float factor = static_cast<float>(width) / static_cast<float>(coarse.width());
  tbb::parallel_for(0, height, [&](int y) {
    const auto* own = level.left.ptr<cv::Vec3b>(y);
    const int middle_y = std::min(y / 2, coarse.height() - 1);
    for (int x = 0; x < width; ++x) {
      const int middle_x = std::min(x / 2, coarse.width() - 1);
      int least = std::numeric_limits<int>::max();
      for (int j = std::max(middle_y - 1, 0); j <= std::min(middle_y + 1, coarse.height() - 1); ++j) {
        const auto* colours = coarse_level.left.ptr<cv::Vec3b>(j);
        for (int i = std::max(middle_x - 1, 0); i <= std::min(middle_x + 1, coarse.width() - 1); ++i) {
          constexpr int own_pixel_bonus = 12;  // neighbours must be clearly more alike
          const bool own_pixel = i == middle_x && j == middle_y;
          const int distance = colour_distance(own[x], colours[i]) - (own_pixel ? own_pixel_bonus : 0);
          if (distance >= least) continue;
          least = distance;
          result(x, y) = coarse(i, j) * factor;
        }
      }
    }
  });
  return result;
}

SearchBand whole_range(cv::Size size, const DisparityRange& range) {
  return {Image<std::int16_t>(size.width, size.height, static_cast<std::int16_t>(range.least)),
          range.largest - range.least + 1};
}

SearchBand band_around(const Image<float>& disparity) {
  SearchBand band{Image<std::int16_t>(disparity.width(), disparity.height()), fine_count};
  std::ranges::transform(disparity.pixels(), band.first.pixels().begin(),
                         [](float d) { return static_cast<std::int16_t>(std::lround(d) - fine_count / 2); });
  return band;
}

/// Checks and completes what was found at one size. `guess`, empty at the coarsest, is what the coarser copy had: it
/// stays where this size finds nothing.
CheckedMatch checked(BandMatch match, const Level& level, const Image<float>& guess, const Image<float>& guess_found,
                     const MatchOptions& options) {
  CheckedMatch result;
  result.found = options.left_right_check ? confirmed_disparity(match.left, match.right, -1, options.check_tolerance_px)
                                          : match.left;
  result.right = options.left_right_check ? confirmed_disparity(match.right, match.left, 1, options.check_tolerance_px)
                                          : match.right;
  remove_speckles(result.found, options.least_surface_px);
  if (known_share(result.found) == 0) throw Error(ErrorKind::bad_input, "no pixel of the two pictures matches");
  if (guess.empty()) {
    result.left = result.found;
    fill_in_picture(result.left, match.right, level.left);
    return result;
  }
  result.left = guess;
  for (std::size_t i = 0; i < result.left.pixels().size(); ++i) {
    float& found = result.found.pixels()[i];
    if (!std::isfinite(found)) found = guess_found.pixels()[i];
    if (std::isfinite(found)) result.left.pixels()[i] = found;
  }
  return result;
}

}  // namespace

CheckedMatch match_coarse_to_fine(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                                  const MatchOptions& options, const Progress& progress) {
  const std::vector<Level> levels = levels_of(left, exposed_alike(left, right), coarsest_scale(left.size(), range));
  CheckedMatch match;
  for (std::size_t i = levels.size(); i-- > 0;) {
    const Level& level = levels[i];
    report(progress, "matching", 1 - static_cast<double>(level.left.total()) / static_cast<double>(left.total()));
    Image<float> guess, guess_found;
    SearchBand band;
    if (i + 1 == levels.size()) {
      const double scale = static_cast<double>(level.left.cols) / left.cols;
      band = whole_range(level.left.size(), {static_cast<int>(std::floor(range.least * scale)),
                                             static_cast<int>(std::ceil(range.largest * scale))});
    } else {
      guess = enlarged_along_edges(match.left, levels[i + 1], level);
      guess_found = enlarged_along_edges(match.found, levels[i + 1], level);
      band = band_around(guess);
    }
    match = checked(match_semi_global(level.left, level.right, band), level, guess, guess_found, options);
  }
  return match;
}

}  // namespace wheatstone
