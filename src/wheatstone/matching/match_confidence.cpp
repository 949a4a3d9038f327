#include "wheatstone/matching/match_confidence.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/map_flaws_internal.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/percentile.h"

namespace wheatstone {
namespace {

template <class Value>
Value middle_of(std::vector<Value>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Fine detail of a picture as it is matched: the mean magnitude of its Laplacian, above what noise makes of it.
double detail_of(const Image<Rgb8>& picture) {
  constexpr int side_px = 640;
  const double scale = std::min(1.0, static_cast<double>(side_px) / picture.width());
  cv::Mat small = shrunk(as_mat(picture), scale), edges;
  cv::cvtColor(small, small, cv::COLOR_RGB2GRAY);
  cv::Laplacian(small, edges, CV_32F);
  return cv::mean(cv::abs(edges))[0] / std::max(cv::mean(small)[0], 1.0);
}

struct Spread {
  float least = 0, largest = 0;  ///< the 2nd and the 98th percentile
};

/// The shares of pixels at or beyond either end of a range.
struct EndShares {
  double least = 0, largest = 0;
};

EndShares shares_at_ends(const Image<float>& disparity, const DisparityRange& range) {
  const auto share_of = [&](auto is_there) {
    return static_cast<double>(std::ranges::count_if(disparity.pixels(), is_there)) /
           static_cast<double>(disparity.pixels().size());
  };
  constexpr float reach = 0.5f;
  return {share_of([&](float d) { return d <= static_cast<float>(range.least) + reach; }),
          share_of([&](float d) { return d >= static_cast<float>(range.largest) - reach; })};
}

/// What is at an end of the range was either there or would be beyond: a search of its own tells.
std::optional<RangeMisfit> cut_by(const DisparityRange& asked, const StereoPair& pair, const Image<float>& disparity) {
  constexpr double least_share = 0.02;
  const EndShares at = shares_at_ends(disparity, asked);
  if (std::max(at.least, at.largest) < least_share) return {};
  const std::optional<SeenDisparities> seen = find_seen_disparities(pair);
  if (!seen) return {};
  const float beyond = std::max(2.f, 0.005f * static_cast<float>(pair.left.width()));
  const bool cuts_least = at.least >= least_share && seen->least < static_cast<float>(asked.least) - beyond;
  const bool cuts_largest = at.largest >= least_share && seen->largest > static_cast<float>(asked.largest) + beyond;
  if (!cuts_least && !cuts_largest) return {};
  return RangeMisfit{asked,
                     {static_cast<int>(std::floor(seen->least)), static_cast<int>(std::ceil(seen->largest))},
                     (cuts_least ? at.least : 0) + (cuts_largest ? at.largest : 0)};
}

/// Whether the range is many times what was found in it: copies are then matched smaller, and chance matches more.
std::optional<RangeMisfit> too_wide(const DisparityRange& asked, const Spread& found, int width) {
  constexpr double many_times = 6, least_share_of_width = 1.0 / 16;
  const double needed = std::max(static_cast<double>(found.largest) - found.least, least_share_of_width * width);
  if (asked.largest - asked.least <= many_times * needed) return {};
  return RangeMisfit{asked, {static_cast<int>(std::floor(found.least)), static_cast<int>(std::ceil(found.largest))}, 0};
}

/// Looks at partners in both pictures, and at how far apart they are.
Spread compare_partners(const StereoPair& pair, const StereoGeometry& geometry, MatchConfidence& confidence) {
  const Image<float>& disparity = geometry.left_disparity;
  // A million pixels tell as much as all.
  constexpr double enough = 1e6;
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(disparity.pixels().size()) / enough)));
  std::size_t asked = 0, inside = 0;
  std::vector<int> differences;
  std::vector<float> disparities;
  for (int y = 0; y < disparity.height(); y += step) {
    for (int x = 0; x < disparity.width(); x += step) {
      ++asked;
      disparities.push_back(disparity(x, y));
      const float there = std::floor(static_cast<float>(x) + 0.5f - disparity(x, y));
      if (!(there >= 0 && there < static_cast<float>(disparity.width()))) continue;
      ++inside;
      if (geometry.left_occlusion(x, y) != 0) continue;
      const Rgb8 a = pair.left(x, y), b = pair.right(static_cast<int>(there), y);
      differences.push_back(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b));
    }
  }
  confidence.overlap_share = static_cast<double>(inside) / static_cast<double>(asked);
  if (!differences.empty()) confidence.colour_difference = middle_of(differences) / 3.0;
  confidence.middle_px = percentile(disparities, 0.5);
  return {percentile(disparities, 0.02), percentile(disparities, 0.98)};
}

}  // namespace

MatchConfidence measure_match(const StereoPair& pair, const MatchedPair& matched,
                              const std::optional<DisparityRange>& asked_range) {
  const Image<float>& disparity = matched.geometry.left_disparity;
  MatchConfidence confidence;
  confidence.found_share = matched.left_found_share;
  confidence.plain_share = matched.plain_share;
  double left_detail = 0, right_detail = 0;
  Spread spread;
  tbb::parallel_invoke([&] { confidence.streak_share = streak_share(disparity); },
                       [&] { confidence.patch_share = patch_share(disparity, pair.left); },
                       [&] { left_detail = detail_of(pair.left); }, [&] { right_detail = detail_of(pair.right); },
                       [&] { spread = compare_partners(pair, matched.geometry, confidence); });
  confidence.left_is_blurrier = left_detail < right_detail;
  const double sharper = std::max(left_detail, right_detail);
  confidence.sharper_share = sharper > 0 ? std::min(left_detail, right_detail) / sharper : 1;
  confidence.depth_px = static_cast<double>(spread.largest) - spread.least;
  if (asked_range) {
    confidence.range = cut_by(*asked_range, pair, disparity);
    if (!confidence.range) confidence.range = too_wide(*asked_range, spread, disparity.width());
  }
  return confidence;
}

namespace {

std::string range_warning(const RangeMisfit& misfit) {
  const auto& [asked, present, cut_share] = misfit;
  if (cut_share == 0)
    return fmt::format(
        "the disparity range {}:{} is far wider than what the pictures have, {} to {} pixels, so that details are "
        "lost; "
        "narrow --range, or leave it out",
        asked.least, asked.largest, present.least, present.largest);
  return fmt::format(
      "{:.0f} % of the disparity is at the end of the range {}:{}, but the pictures have disparities from {} to {} "
      "pixels; widen --range, or leave it out",
      100 * cut_share, asked.least, asked.largest, present.least, present.largest);
}

}  // namespace

std::string match_warning(const MatchConfidence& confidence) {
  constexpr double least_found = 0.7, most_streaks = 0.03, least_depth_px = 1;
  constexpr double least_overlap = 0.6, least_sharpness = 0.5, most_plain = 0.2;
  const bool much_is_plain = confidence.plain_share > most_plain && confidence.found_share < least_found;
  if (confidence.range && confidence.range->cut_share > 0) return range_warning(*confidence.range);
  if (confidence.depth_px < least_depth_px && !much_is_plain)
    return std::abs(confidence.middle_px) < least_depth_px
               ? "the pictures show no depth: all disparities are about 0, as of one picture twice or of two taken "
                 "from "
                 "one place; move the camera sideways between the pictures"
               : fmt::format(
                     "the pictures show no depth: all disparities are about {:.0f} pixels, as of a flat or distant "
                     "scene",
                     confidence.middle_px);
  if (confidence.sharper_share < least_sharpness)
    return fmt::format(
        "the {} picture is blurred relative to the other one, so that details have no partners; use a "
        "sharper picture, or match reduced copies (--max-size 800)",
        confidence.left_is_blurrier ? "left" : "right");
  if (confidence.overlap_share < least_overlap)
    return fmt::format(
        "the views overlap by only {:.0f} % of the width; the rest has no depth of its own; crop both "
        "pictures to what they have in common, or move the camera less between them",
        100 * confidence.overlap_share);
  if (confidence.range) return range_warning(*confidence.range);
  if (confidence.found_share >= least_found && confidence.streak_share <= most_streaks) return {};
  const std::string found = fmt::format("only {:.0f} % of the disparity is certain", 100 * confidence.found_share);
  if (much_is_plain)
    return fmt::format(
        "{}: {:.0f} % of the picture is plain, and its depth is guessed from its surroundings; a "
        "background with texture helps",
        found, 100 * confidence.plain_share);
  return fmt::format(
      "{}: parts of the pictures do not correspond, as when things moved between two exposures; take both "
      "at one moment, or widen --range if near things are missing",
      found);
}

}  // namespace wheatstone
