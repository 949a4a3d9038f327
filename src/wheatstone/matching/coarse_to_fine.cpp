#include "wheatstone/matching/coarse_to_fine_internal.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/enlarge_internal.h"
#include "wheatstone/matching/fill_in_picture_internal.h"
#include "wheatstone/matching/levels_internal.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/semi_global_internal.h"
#include "wheatstone/matching/trusted_places_internal.h"

namespace wheatstone {
namespace {

/// What one size leaves to the next.
struct CoarserGuess {
  Image<float> left, found;
  cv::Mat confirmed;
};

/// Checks and completes what was found at one size. `guess`, none at the coarsest, is what the coarser copy had: it
/// stays where this size finds nothing.
CheckedMatch checked(const BandMatch& match, const Level& level, std::optional<CoarserGuess> guess,
                     const MatchOptions& options) {
  CheckedMatch result;
  result.found = options.left_right_check ? confirmed_disparity(match.left, match.right, -1, options.check_tolerance_px)
                                          : match.left;
  result.right = options.left_right_check ? confirmed_disparity(match.right, match.left, 1, options.check_tolerance_px)
                                          : match.right;
  TrustedPlaces places;
  tbb::parallel_invoke(
      [&] {
        if (guess) {
          remove_speckles(result.found, options.least_surface_px);
        } else {
          remove_speckles_but_holes(result.found, options.least_surface_px);
        }
      },
      [&] { places = trusted_places(level.left, match); });
  result.plain = places.plain;
  result.confirmed.create(level.left.size(), CV_8U);
  if (guess) result.left = std::move(guess->left);
  cv::Mat confirmed_before;
  if (guess) cv::resize(guess->confirmed, confirmed_before, level.left.size(), 0, 0, cv::INTER_NEAREST);
  for_each_band(level.left.rows, [&](const cv::Range& rows) {
    cv::Mat found = as_mat(result.found).rowRange(rows), confirmed = result.confirmed.rowRange(rows);
    cv::compare(found, found, confirmed, cv::CMP_EQ);
    found.setTo(unknown, places.plain.rowRange(rows) | ~places.distinct.rowRange(rows));
    if (!guess) return;
    as_mat(guess->found).rowRange(rows).copyTo(found, unknown_places(found));
    cv::Mat left = as_mat(result.left).rowRange(rows);
    found.copyTo(left, found == found);
    confirmed |= confirmed_before.rowRange(rows);
  });
  if (guess) return result;
  // Nothing but plain places is no reason to refuse: whatever was found there is as good as anything.
  if (known_share(result.found) == 0) result.found = match.left;
  result.left = result.found;
  fill_in_picture(result.left, match.right, {level.left, result.plain});
  return result;
}

}  // namespace

CheckedMatch match_coarse_to_fine(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                                  const MatchOptions& options, const Progress& progress) {
  const std::vector<Level> levels = levels_of(left, right, range);
  CheckedMatch match;
  std::size_t pixels = 0, matched = 0;
  for (const Level& level : levels) pixels += level.left.total();
  for (std::size_t i = levels.size(); i-- > 0;) {
    const Level& level = levels[i];
    report(progress, "matching", static_cast<double>(matched) / static_cast<double>(pixels));
    matched += level.left.total();
    std::optional<CoarserGuess> guess;
    SearchBand band;
    if (i + 1 == levels.size()) {
      band = whole_range(level, static_cast<double>(level.left.cols) / left.cols, range);
    } else {
      const Image<std::uint8_t> alike = most_alike_neighbours(levels[i + 1].left, level.left);
      guess = {{}, {}, match.confirmed};
      tbb::parallel_invoke([&] { guess->left = enlarged(match.left, alike); },
                           [&] { guess->found = enlarged(match.found, alike); });
      match = {};
      band = band_around(guess->left);
    }
    match = checked(match_semi_global(level.left, level.right, band), level, std::move(guess), options);
  }
  return match;
}

void refine_at_double_size(const cv::Mat& left, const cv::Mat& right, Image<float>& disparity) {
  cv::Mat large_left, large_right;
  cv::resize(left, large_left, {}, 2, 2, cv::INTER_CUBIC);
  cv::resize(exposed_alike(left, right), large_right, {}, 2, 2, cv::INTER_CUBIC);
  Image<float> guess(large_left.cols, large_left.rows);
  cv::Mat large_guess = as_mat(guess);
  cv::resize(as_mat(disparity), large_guess, large_guess.size(), 0, 0, cv::INTER_NEAREST);
  large_guess *= 2;
  const BandMatch match = match_semi_global(large_left, large_right, band_around(guess));
  const Image<float> confirmed = confirmed_disparity(match.left, match.right, -1, 1);
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    for (int x = 0; x < disparity.width(); ++x) {
      float sum = 0;
      int count = 0;
      for (int i = 0; i < 4; ++i) {
        const float found = confirmed(2 * x + i % 2, 2 * y + i / 2) / 2;
        // NaN is not within a pixel.
        if (!(std::abs(found - disparity(x, y)) <= 0.5f)) continue;
        sum += found;
        ++count;
      }
      if (count > 0) disparity(x, y) = sum / static_cast<float>(count);
    }
  });
}

}  // namespace wheatstone
