#include "wheatstone/matching/match_near.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/enlarge_internal.h"
#include "wheatstone/matching/levels_internal.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

/// What a guess is judged by.
struct GreyPair {
  cv::Mat left, right;
};

/// How badly the right picture, moved by a disparity, fits the left one around each pixel: mean difference of grey
/// levels, 0..255. What leads out of the picture, or is not known, does not fit at all.
cv::Mat misfit(const GreyPair& pair, const Image<float>& disparity) {
  constexpr int window_px = 7;
  constexpr std::uint8_t worst = 255;
  cv::Mat difference(pair.left.size(), CV_8U), mean;
  tbb::parallel_for(0, difference.rows, [&](int y) {
    const auto* left = pair.left.ptr<std::uint8_t>(y);
    const auto* right = pair.right.ptr<std::uint8_t>(y);
    auto* to = difference.ptr<std::uint8_t>(y);
    const auto along = disparity.row(y);
    for (int x = 0; x < difference.cols; ++x) {
      const float there = std::floor(static_cast<float>(x) + 0.5f - along[x]);
      const bool inside = there >= 0 && there < static_cast<float>(difference.cols);
      to[x] = inside ? static_cast<std::uint8_t>(std::abs(left[x] - right[static_cast<int>(there)])) : worst;
    }
  });
  cv::boxFilter(difference, mean, -1, {window_px, window_px});
  return mean;
}

/// A disparity for every pixel, near which it is looked for.
struct Guess {
  Image<float> disparity;
  cv::Mat misfit;
};

/// Takes another disparity where that fits by more than `clearly` grey levels better; with a negative number, also
/// where it fits no worse than that.
void improve(const GreyPair& pair, const Image<float>& other, int clearly, Guess& guess) {
  const cv::Mat other_misfit = misfit(pair, other);
  cv::Mat better;
  cv::compare(other_misfit + clearly, guess.misfit, better, cv::CMP_LT);
  as_mat(other).copyTo(as_mat(guess.disparity), better);
  other_misfit.copyTo(guess.misfit, better);
}

/// Depth edges may lie some pixels beside those of a guess: where the surfaces on both sides lie within a band, the
/// band is to hold both; elsewhere that which fits is taken.
void look_beyond_edges(const GreyPair& pair, Guess& guess) {
  constexpr int window_px = 9, clearly = 2;
  constexpr float within_band_px = 12;
  const int width = guess.disparity.width(), height = guess.disparity.height();
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {window_px, window_px});
  Image<float> farthest(width, height), nearest(width, height);
  cv::Mat least = as_mat(farthest), largest = as_mat(nearest);
  tbb::parallel_invoke([&] { cv::erode(as_mat(guess.disparity), least, window); },
                       [&] { cv::dilate(as_mat(guess.disparity), largest, window); });
  improve(pair, farthest, clearly, guess);
  improve(pair, nearest, clearly, guess);
  const cv::Mat both = largest - least <= within_band_px;
  cv::Mat middle = (least + largest) / 2;
  middle.copyTo(as_mat(guess.disparity), both);
}

/// The whole range in the coarsest copy, brought to the pair's size along the edges of the pictures between. Empty
/// where nothing is found.
Image<float> coarse_guess(const std::vector<Level>& levels, const DisparityRange& range, const MatchOptions& options) {
  const Level& coarsest = levels.back();
  const double scale = static_cast<double>(coarsest.left.cols) / levels.front().left.cols;
  const BandMatch match = match_semi_global(coarsest.left, coarsest.right, whole_range(coarsest, scale, range));
  Image<float> guess = confirmed_disparity(match.left, match.right, -1, options.check_tolerance_px);
  remove_speckles(guess, options.least_surface_px);
  if (known_share(guess) == 0) return {};
  fill_from_farther_side(guess);
  for (std::size_t i = levels.size() - 1; i-- > 0;)
    guess = enlarged(guess, most_alike_neighbours(levels[i + 1].left, levels[i].left));
  return guess;
}

/// An image of disparities in another size of the pictures; the values are those of single pixels.
Image<float> at_size(const Image<float>& disparity, cv::Size size, double scale) {
  Image<float> result(size.width, size.height);
  cv::Mat target = as_mat(result);
  cv::resize(as_mat(disparity), target, size, 0, 0, cv::INTER_NEAREST);
  target *= scale;
  return result;
}

/// Keeps what was expected where nothing moves, unless what was found fits better. Elsewhere, what fits as well may lie
/// beside a depth edge that has moved.
void keep_where_still(const GreyPair& pair, const Image<float>& expected, ImageView<const std::uint8_t> still,
                      Image<float>& disparity) {
  constexpr float changed_px = 0.5f;
  constexpr int noise = 1;
  const cv::Mat misfit_of_expected = misfit(pair, expected), misfit_now = misfit(pair, disparity);
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto* of_expected = misfit_of_expected.ptr<std::uint8_t>(y);
    const auto* now = misfit_now.ptr<std::uint8_t>(y);
    const auto from = expected.row(y);
    const auto to = disparity.row(y);
    for (int x = 0; x < disparity.width(); ++x)
      if (still(x, y) != 0 && std::abs(from[x] - to[x]) > changed_px && of_expected[x] <= now[x] + noise)
        to[x] = from[x];
  });
}

cv::Mat shrunk_to(const Image<Rgb8>& picture, cv::Size size) {
  cv::Mat small = as_mat(picture);
  if (small.size() != size) cv::resize(small, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

std::optional<MatchedPair> match_near(const StereoPair& pair, const Image<float>& expected, const MatchOptions& options,
                                      ImageView<const std::uint8_t> still) {
  const int width = pair.left.width(), height = pair.left.height();
  const cv::Size size(static_cast<int>(width * options.size), static_cast<int>(height * options.size));
  const double scale = static_cast<double>(size.width) / width;
  const DisparityRange range{static_cast<int>(std::floor(options.range->least * scale)),
                             static_cast<int>(std::ceil(options.range->largest * scale))};
  constexpr int least_side_px = 32;  // of which there is a copy
  if (std::min(size.width, size.height) < least_side_px) return {};
  constexpr double coarsest = 0.5;
  const std::vector<Level> levels = levels_of(shrunk_to(pair.left, size), shrunk_to(pair.right, size), range, coarsest);
  const Level& level = levels.front();
  Guess guess{coarse_guess(levels, range, options), {}};
  if (guess.disparity.empty()) return {};

  GreyPair grey;
  cv::cvtColor(level.left, grey.left, cv::COLOR_RGB2GRAY);
  cv::cvtColor(level.right, grey.right, cv::COLOR_RGB2GRAY);
  guess.misfit = misfit(grey, guess.disparity);
  constexpr int noise = 2;
  const Image<float> expected_here = at_size(expected, size, scale);
  improve(grey, expected_here, -noise, guess);
  look_beyond_edges(grey, guess);

  const BandMatch match = match_semi_global(level.left, level.right, band_around(guess.disparity));
  Image<float> disparity = confirmed_disparity(match.left, match.right, -1, options.check_tolerance_px);
  remove_speckles(disparity, options.least_surface_px);
  MatchedPair matched{.range = *options.range, .left_found_share = known_share(disparity)};
  if (matched.left_found_share == 0) return {};
  matched.right_found_share = known_share(match.right);
  fill_from_farther_side(disparity);
  constexpr int median_px = 5;
  const cv::Mat filled = as_mat(disparity).clone();
  cv::medianBlur(filled, as_mat(disparity), median_px);
  if (!still.empty()) keep_where_still(grey, expected_here, still, disparity);
  if (size.width != width) disparity = at_size(disparity, {width, height}, 1 / scale);
  matched.geometry = geometry_from_left(std::move(disparity));
  return matched;
}

}  // namespace wheatstone
