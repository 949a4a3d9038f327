#include "wheatstone/matching/match.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/module.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/coarse_to_fine_internal.h"
#include "wheatstone/matching/confirm_internal.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/match_reliability_internal.h"
#include "wheatstone/matching/refine_wls_internal.h"
#include "wheatstone/matching/weighted_median_internal.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

constexpr std::array<std::string_view, 5> names{"census", "sgbm", "bm", "dp", "onnx"};
constexpr std::array<std::string_view, 3> values_names{"255", "1", "imagenet"};
constexpr std::array<std::string_view, 3> quality_names{"fast", "good", "best"};
constexpr int least_side_px = 16;
constexpr double most_pixels = 12e6;
constexpr int most_disparities = 512;

template <class Value>
std::optional<Value> by_name(std::span<const std::string_view> all, std::string_view name) {
  const auto found = std::ranges::find(all, name);
  if (found == all.end()) return {};
  return static_cast<Value>(found - all.begin());
}

void check(const StereoPair& pair, const MatchOptions& options) {
  check_fits(pair);
  if (pair.left.width() < least_side_px || pair.left.height() < least_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("the pictures are {}x{} pixels, expected at least {}x{}",
                                                  pair.left.width(), pair.left.height(), least_side_px, least_side_px));
  if (options.block_px < 1 || options.block_px > 51 || options.block_px % 2 == 0)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the matching block is {} pixels wide, expected an odd number, 1 to 51", options.block_px));
  if (!(options.size > 0 && options.size <= 1))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the matching scale is {}, expected above 0 and at most 1", options.size));
  if (options.matcher == Matcher::onnx && options.model.empty())
    throw Error(ErrorKind::wrong_usage, "matching by a neural network needs a model file (.onnx)");
  if (options.range &&
      (options.range->least >= options.range->largest ||
       std::max(std::abs(options.range->least), std::abs(options.range->largest)) >= pair.left.width()))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the disparity range is {}:{}, expected least:largest within the width of {} pixels",
                            options.range->least, options.range->largest, pair.left.width()));
}

Image<float> match_one_way(const cv::Mat& own, const cv::Mat& other, const DisparityRange& range,
                           const MatchOptions& options) {
  if (options.matcher == Matcher::onnx) return match_with_network(own, other, options);
  if (options.matcher != Matcher::dp) return match_with_opencv(own, other, range, options);
  cv::Mat own_luminance, other_luminance;
  cv::cvtColor(own, own_luminance, cv::COLOR_RGB2GRAY);
  cv::cvtColor(other, other_luminance, cv::COLOR_RGB2GRAY);
  return match_scan_lines(own_luminance, other_luminance, range);
}

/// The right eye's disparity is the left eye's of the pair seen in a mirror.
Image<float> match_right(const cv::Mat& left, const cv::Mat& right, const DisparityRange& range,
                         const MatchOptions& options) {
  cv::Mat mirrored_left, mirrored_right;
  cv::flip(left, mirrored_left, 1);
  cv::flip(right, mirrored_right, 1);
  Image<float> disparity = match_one_way(mirrored_right, mirrored_left, range, options);
  cv::Mat matrix = as_mat(disparity);
  cv::flip(matrix, matrix, 1);
  return disparity;
}

/// Weighted least squares, led by the picture's edges and by what both views agree on. Where the views agree on nothing
/// far and wide the filter returns numbers without meaning; there the disparity stays as it was.
Image<float> refined(const Image<float>& left, const Image<float>& right, const cv::Mat& left_picture,
                     const DisparityRange& range, const MatchOptions& options) {
  static auto* const refine =
      reinterpret_cast<RefineWls*>(function_of_module(wls_module_name, refine_wls_name, wls_module_bytes));
  cv::Mat result;
  refine({.left_disparity = in_sixteenths(left, 1),
          .right_disparity = in_sixteenths(right, -1),
          .left_picture = left_picture,
          .lambda = options.wls_lambda,
          .sigma = options.wls_sigma,
          .check_tolerance = static_cast<int>(options.check_tolerance_px * sixteenths_a_px),
          .radius_px = options.block_px},
         result);
  Image<float> disparity = left;
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) {
      const float value = static_cast<float>(result.at<std::int16_t>(y, x)) / sixteenths_a_px;
      if (value >= static_cast<float>(range.least) && value <= static_cast<float>(range.largest))
        disparity(x, y) = value;
    }
  }
  return disparity;
}

/// Replaces doubtful places; those that were are NaN in the result, which else is the disparity as it was found. Where
/// nearly nothing is beyond doubt the disparity stays as it is.
Image<float> distrust(Image<float>& left, const Image<float>& right, const StereoPair& pair,
                      const DisparityRange& range) {
  const Image<std::uint8_t> distinct = find_distinct_matches(as_mat(pair.left), as_mat(pair.right), left, range);
  constexpr double least_share = 0.05;
  if (cv::countNonZero(as_mat(distinct)) < least_share * static_cast<double>(distinct.pixels().size())) return left;
  Image<float> found = left;
  replace_doubtful(left, right, distinct, range);
  for (std::size_t i = 0; i < found.pixels().size(); ++i)
    if (found.pixels()[i] != left.pixels()[i]) found.pixels()[i] = unknown;
  return found;
}

/// Refinement knows edges better, but rounds what matching found between whole pixels: where they agree to a pixel,
/// what was found stays, and so does what replaced doubtful places.
void keep_confirmed(const Image<float>& before, const Image<float>& found, Image<float>& disparity) {
  for (std::size_t i = 0; i < before.pixels().size(); ++i) {
    const float was = before.pixels()[i];
    const bool replaced = std::isfinite(was) && !std::isfinite(found.pixels()[i]);
    if (replaced || std::abs(was - disparity.pixels()[i]) <= 1) disparity.pixels()[i] = was;
  }
}

/// The steps of every matcher but ours: matched both ways and checked. What is not found stays unknown.
CheckedMatch match_both_ways(const cv::Mat& left_picture, const cv::Mat& right_picture, const DisparityRange& range,
                             const MatchOptions& options) {
  CheckedMatch match;
  Image<float> left, right;
  tbb::parallel_invoke([&] { left = match_one_way(left_picture, right_picture, range, options); },
                       [&] { right = match_right(left_picture, right_picture, range, options); });
  if (options.left_right_check) {
    match.found = confirmed_disparity(left, right, -1, options.check_tolerance_px);
    match.right = confirmed_disparity(right, left, 1, options.check_tolerance_px);
  } else {
    match.found = std::move(left);
    match.right = std::move(right);
  }
  remove_speckles(match.found, options.least_surface_px);
  remove_speckles(match.right, options.least_surface_px);
  match.left = match.found;
  match.confirmed = as_mat(match.found) == as_mat(match.found);
  return match;
}

/// The share of a mask's pixels that are set; 0 where there is no mask.
double share_of(const cv::Mat& mask) {
  return mask.empty() ? 0 : static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

/// MatchedPair::left_confidence.
Image<std::uint8_t> confidence_of(const CheckedMatch& match) {
  Image<std::uint8_t> confidence(match.found.width(), match.found.height());
  cv::Mat sum = as_mat(confidence);
  const cv::Mat trusted = as_mat(match.found) == as_mat(match.found);
  cv::addWeighted(match.confirmed, 0.5, trusted, 0.5, 0, sum);
  return confidence;
}

/// The median of 5×5 pixels, on all processors.
void take_median(Image<float>& disparity) {
  constexpr int side_px = 5, margin = side_px / 2;
  const Image<float> before = disparity;
  const cv::Mat from = as_mat(before);
  cv::Mat to = as_mat(disparity);
  for_each_band(from.rows, [&](const cv::Range& rows) {
    const int top = std::max(rows.start - margin, 0), bottom = std::min(rows.end + margin, from.rows);
    cv::Mat median;
    cv::medianBlur(from.rowRange(top, bottom), median, side_px);
    median.rowRange(rows.start - top, rows.end - top).copyTo(to.rowRange(rows));
  });
}

/// What was found over the picture is smoothed where colours are alike, and found to parts of a pixel where wanted.
void refine_ours(CheckedMatch& match, const cv::Mat& left, const cv::Mat& right, const MatchOptions& options) {
  take_median(match.left);
  match.left =
      weighted_median(match.left, left, options.double_size ? WeightedMedianOptions{4, 2} : WeightedMedianOptions{});
  constexpr std::size_t most_doubled = 4'000'000;
  if (options.double_size && left.total() <= most_doubled) refine_at_double_size(left, right, match.left);
}

/// What other matchers do not find is filled row by row; a median across the rows takes the streaks out.
void complete_others(CheckedMatch& match, const StereoPair& pair, const DisparityRange& range,
                     const MatchOptions& options) {
  if (options.distrust) match.found = distrust(match.left, match.right, pair, range);
  const Image<float> before = match.left;
  fill_from_farther_side(match.left);
  if (options.wls) {
    fill_from_farther_side(match.right);
    match.left = refined(match.left, match.right, as_mat(pair.left), range, options);
    if (options.wls_keeps_confirmed) keep_confirmed(before, match.found, match.left);
  }
  take_median(match.left);
}

/// None where no pixel matches.
std::optional<MatchedPair> match_at_this_size(const StereoPair& pair, const DisparityRange& range,
                                              const MatchOptions& options, const Progress& progress) {
  const cv::Mat left = as_mat(pair.left), right = as_mat(pair.right);
  const bool ours = options.matcher == Matcher::census;
  CheckedMatch match =
      ours ? match_coarse_to_fine(left, right, range, options, progress) : match_both_ways(left, right, range, options);
  if (known_share(match.left) == 0) return {};
  MatchedPair matched;
  matched.left_found_share = share_of(match.confirmed);
  matched.plain_share = share_of(match.plain);
  matched.right_found_share = known_share(match.right);
  report(progress, "matching", 1);
  if (!ours) complete_others(match, pair, range, options);
  matched.left_confidence = confidence_of(match);
  if (ours) {
    match.found = {};
    if (!options.wls) match.right = {};
    refine_ours(match, left, right, options);
    if (options.wls && !options.wls_keeps_confirmed) {
      fill_from_farther_side(match.right);
      match.left = refined(match.left, match.right, left, range, options);
    }
  }
  matched.geometry = geometry_from_left(std::move(match.left));
  return matched;
}

/// Smaller by this factor when a pair is too large, or its disparities too many, to be matched as it is.
double reduction_for(const StereoPair& pair, const DisparityRange& range) {
  const double pixels = static_cast<double>(pair.left.width()) * pair.left.height();
  return std::min({1.0, std::sqrt(most_pixels / pixels),
                   static_cast<double>(most_disparities) / (range.largest - range.least + 1)});
}

Image<Rgb8> resized(const Image<Rgb8>& picture, double scale) {
  Image<Rgb8> result(std::max(static_cast<int>(picture.width() * scale), least_side_px),
                     std::max(static_cast<int>(picture.height() * scale), least_side_px));
  cv::Mat target = as_mat(result);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return result;
}

Image<float> at_size(const Image<float>& disparity, int width, int height) {
  Image<float> result(width, height);
  cv::Mat target = as_mat(result);
  cv::resize(as_mat(disparity), target, target.size(), 0, 0, cv::INTER_NEAREST);
  target *= static_cast<double>(width) / disparity.width();
  return result;
}

}  // namespace

std::span<const std::string_view> matcher_names() { return names; }

std::optional<Matcher> matcher_by_name(std::string_view name) { return by_name<Matcher>(names, name); }

std::string_view name_of(Matcher matcher) { return names[static_cast<std::size_t>(matcher)]; }

std::span<const std::string_view> network_values_names() { return values_names; }

std::optional<NetworkValues> network_values_by_name(std::string_view name) {
  return by_name<NetworkValues>(values_names, name);
}

std::span<const std::string_view> match_quality_names() { return quality_names; }

std::optional<MatchQuality> match_quality_by_name(std::string_view name) {
  return by_name<MatchQuality>(quality_names, name);
}

MatchOptions match_options_for(MatchQuality quality) {
  MatchOptions options;
  if (quality == MatchQuality::fast) options.size = 0.5;
  if (quality == MatchQuality::best) {
    options.double_size = true;
    options.distrust = true;
    options.wls = true;
    options.wls_keeps_confirmed = true;
  }
  return options;
}

std::optional<MatchedPair> match_if_any(const StereoPair& pair, const MatchOptions& options, const Progress& progress) {
  check(pair, options);
  report(progress, "matching", 0);
  const DisparityRange range =
      options.range ? *options.range : find_disparity_range(pair).value_or(usual_disparity_range(pair.left.width()));
  constexpr double range_share = 0.2, levels_share = 0.5;  // of the time, roughly; the rest is refinement
  report(progress, "matching", range_share);
  const Progress levels = [&](std::string_view step, double done) {
    report(progress, step, range_share + levels_share * done);
  };
  const double scale = std::min(options.size, reduction_for(pair, range));
  std::optional<MatchedPair> matched;
  if (scale == 1) {
    matched = match_at_this_size(pair, range, options, levels);
  } else {
    const StereoPair small{resized(pair.left, scale), resized(pair.right, scale)};
    const DisparityRange small_range{static_cast<int>(std::floor(range.least * scale)),
                                     static_cast<int>(std::ceil(range.largest * scale))};
    matched = match_at_this_size(small, small_range, options, levels);
  }
  if (!matched) return {};
  matched->range = range;
  if (scale != 1) {
    const int width = pair.left.width(), height = pair.left.height();
    matched->geometry = geometry_from_left(at_size(matched->geometry.left_disparity, width, height));
    Image<std::uint8_t> confidence(width, height);
    cv::Mat target = as_mat(confidence);
    cv::resize(as_mat(matched->left_confidence), target, target.size(), 0, 0, cv::INTER_NEAREST);
    matched->left_confidence = std::move(confidence);
  }
  report(progress, "matching", 1);
  return matched;
}

MatchedPair match(const StereoPair& pair, const MatchOptions& options, const Progress& progress) {
  std::optional<MatchedPair> matched = match_if_any(pair, options, progress);
  if (matched) return *std::move(matched);
  const std::string between =
      options.range ? fmt::format(" between disparities {} and {}", options.range->least, options.range->largest) : "";
  throw Error(ErrorKind::bad_input, fmt::format("no pixel of the two pictures matches{}", between));
}

}  // namespace wheatstone
