#include "wheatstone/calibration/prepare_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/calibration/rectify.h"
#include "wheatstone/calibration/rectify_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_features.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {
namespace {

/// Enough to tell, and quick.
constexpr FeatureOptions quick_search{.most_features = 1000, .search_side_px = 960};

/// What two pictures have in common, as far as one geometry of two cameras explains it.
struct CommonFeatures {
  std::vector<FeatureMatch> inliers;
  bool convincing = false;  ///< most of the matches fit, and they are more than chance makes
};

CommonFeatures common_features(ImageView<const Rgb8> left, ImageView<const Rgb8> right) {
  constexpr std::size_t least_inliers = 16;
  const FeatureMatches found = match_features(left, right, quick_search);
  const double tolerance = epipolar_tolerance_px(std::max(left.width(), left.height()));
  CommonFeatures common;
  // A lens that bends straight lines leaves few matches close to the lines of straight ones.
  for (const double poor_lens : {1.0, 4.0}) {
    EpipolarGeometry geometry = find_epipolar_geometry(found.matches, poor_lens * tolerance);
    common.convincing = static_cast<double>(geometry.inliers.size()) >= poor_lens * least_inliers &&
                        2 * geometry.inliers.size() >= found.matches.size();
    common.inliers = std::move(geometry.inliers);
    if (common.convincing) break;
  }
  return common;
}

/// Whether a picture shows nothing: black, or of one colour but for noise.
bool is_blank(const Image<Rgb8>& picture) {
  constexpr int small_side_px = 64;
  constexpr double least_deviation = 1.5;
  cv::Mat small;
  const cv::Size size(std::min(picture.width(), small_side_px), std::min(picture.height(), small_side_px));
  cv::resize(as_mat(picture), small, size, 0, 0, cv::INTER_AREA);
  cv::Scalar mean, deviation;
  cv::meanStdDev(small, mean, deviation);
  return std::max({deviation[0], deviation[1], deviation[2]}) < least_deviation;
}

/// By which angle the right picture is turned against the left one, in degrees from −180 to 180: the least squares of
/// the matches' places around their means.
double turn_between(std::span<const FeatureMatch> matches) {
  PicturePoint left, right;
  const double share = 1 / static_cast<double>(matches.size());
  for (const FeatureMatch& match : matches) {
    left = {left.x + share * match.left.x, left.y + share * match.left.y};
    right = {right.x + share * match.right.x, right.y + share * match.right.y};
  }
  double along = 0, across = 0;
  for (const FeatureMatch& match : matches) {
    const double from_x = match.left.x - left.x, from_y = match.left.y - left.y;
    const double to_x = match.right.x - right.x, to_y = match.right.y - right.y;
    along += from_x * to_x + from_y * to_y;
    across += from_x * to_y - from_y * to_x;
  }
  return std::atan2(across, along) * 180 / std::numbers::pi;
}

void check_pictures(const StereoPair& pair) {
  if (pair.left.empty()) throw Error(ErrorKind::bad_input, "the left picture has no pixels");
  check_fits(pair);
  const bool left_is_blank = is_blank(pair.left), right_is_blank = is_blank(pair.right);
  if (left_is_blank || right_is_blank)
    throw Error(ErrorKind::bad_input, fmt::format("the {} blank: expected two views of one scene",
                                                  left_is_blank && right_is_blank ? "pictures are both"
                                                  : left_is_blank                 ? "left picture is"
                                                                                  : "right picture is"));
}

void check_upright(std::span<const FeatureMatch> matches) {
  constexpr double on_its_side = 45, upside_down = 135;
  const double turn = std::abs(turn_between(matches));
  if (turn > upside_down)
    throw Error(ErrorKind::bad_input, "the right picture is upside down relative to the left one");
  if (turn > on_its_side)
    throw Error(ErrorKind::bad_input, "the right picture is turned by 90 degrees relative to the left one");
}

/// Why pictures with hardly any features in common are none of a pair, where that can be told.
void check_dissimilar(const StereoPair& pair) {
  Image<Rgb8> mirrored(pair.right.width(), pair.right.height());
  cv::Mat target = as_mat(mirrored);
  cv::flip(as_mat(pair.right), target, 1);
  const CommonFeatures common = common_features(pair.left, mirrored);
  if (common.convincing) {
    const bool upside_down = std::abs(turn_between(common.inliers)) > 90;
    throw Error(ErrorKind::bad_input, upside_down
                                          ? "the right picture is upside down and mirrored relative to the left one"
                                          : "the right picture is mirrored relative to the left one");
  }
  if (not_a_pair(pair))
    throw Error(ErrorKind::bad_input, "the pictures show different scenes, expected two views of one scene");
}

bool rows_fit(const VerticalDisparity& rows, const VerticalDisparity& tolerated) {
  return rows.median_px <= tolerated.median_px && rows.percentile_95_px <= tolerated.percentile_95_px;
}

VerticalDisparity tolerated_rows(int longer_side_px) {
  // A place in a reduced copy is known no better than to a quarter of its pixels.
  return {std::max(1.0, 0.25 * longer_side_px / quick_search.search_side_px),
          std::max(3.0, epipolar_tolerance_px(longer_side_px))};
}

/// Whether rectifying brought the same matches, which did not decide it, clearly closer.
bool rectifying_helped(const RectifiedPair& rectified) {
  constexpr double clearly = 0.75;
  const VerticalDisparity &before = rectified.before, &after = rectified.after;
  return rectified.measured_matches > 0 &&
         (after.median_px < clearly * before.median_px ||
          (after.median_px <= before.median_px && after.percentile_95_px < clearly * before.percentile_95_px));
}

void take(RectifiedPair rectified, PreparedPair& prepared) {
  prepared.pictures = std::move(rectified.pictures);
  prepared.rectification = rectified.rectification;
  prepared.colour = rectified.colour;
  if (rectified.measured_matches == 0) return;
  prepared.compared_features = rectified.measured_matches;
  prepared.photographed_rows = rectified.before;
  prepared.rows = rectified.after;
}

/// Rectifies a pair whose rows do not fit, where that makes them fit better.
void rectify_if_it_helps(PreparedPair& prepared, const RectifyOptions& options, const Progress& progress) {
  try {
    RectifiedPair rectified = rectify(prepared.pictures, options, progress);
    if (rectifying_helped(rectified)) {
      take(std::move(rectified), prepared);
    } else {
      prepared.why_not_rectified = "no rotation of the cameras makes the rows fit better";
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) throw;
    prepared.why_not_rectified = error.what();
  }
}

/// Disparities of matches, and as much again to either side: of what lies between, few are matched.
DisparityRange disparities_around(std::span<const FeatureMatch> matches) {
  constexpr double least_room_px = 16;
  const auto [farthest, nearest] =
      std::ranges::minmax(matches, {}, [](const FeatureMatch& match) { return match.left.x - match.right.x; });
  const double least = farthest.left.x - farthest.right.x, largest = nearest.left.x - nearest.right.x;
  const double room = std::max((largest - least) / 2, least_room_px);
  return {static_cast<int>(std::floor(least - room)), static_cast<int>(std::ceil(largest + room))};
}

/// Refuses what is no pair, and rectifies where that is wanted. Returns within which disparities its matches lie, where
/// they tell it.
std::optional<DisparityRange> prepare_rows(StereoPair photographs, const PreparePairOptions& options,
                                           const Progress& progress, PreparedPair& prepared) {
  const CommonFeatures common = common_features(photographs.left, photographs.right);
  if (common.convincing) {
    check_upright(common.inliers);
  } else {
    check_dissimilar(photographs);
  }

  prepared.tolerated = tolerated_rows(std::max(photographs.left.width(), photographs.left.height()));
  prepared.pictures = std::move(photographs);
  RectifyOptions rectifying{.keep_size = options.keep_size};
  if (options.rectify == RectifyPolicy::always) {
    take(rectify(prepared.pictures, rectifying, progress), prepared);
    return {};
  }
  if (!common.convincing) return {};
  prepared.compared_features = static_cast<int>(common.inliers.size());
  prepared.rows = prepared.photographed_rows = vertical_disparity(common.inliers);
  rectifying.cameras_must_be_decided = false;
  if (options.rectify == RectifyPolicy::automatic && !rows_fit(*prepared.rows, prepared.tolerated))
    rectify_if_it_helps(prepared, rectifying, progress);
  if (prepared.rectification) return {};
  return disparities_around(common.inliers);
}

}  // namespace

PreparedPair prepare_pair(StereoPair photographs, const PreparePairOptions& options, const Progress& progress) {
  check_pictures(photographs);
  PreparedPair prepared;
  const std::optional<DisparityRange> within = prepare_rows(std::move(photographs), options, progress, prepared);
  if (options.ask_eyes) prepared.eyes = eye_order(prepared.pictures, within);
  return prepared;
}

std::string rectified_note(const PreparedPair& pair) {
  if (!pair.rectification) return {};
  const std::string kept =
      fmt::format("{:.0f} % of the photographs' area is kept", 100 * kept_area(*pair.rectification));
  if (!pair.photographed_rows || !pair.rows) return "the pair was rectified; " + kept;
  return fmt::format(
      "the pair was rectified: its rows differed by {:.1f} pixels (median; 95th percentile {:.1f}), now by {:.1f} "
      "({:.1f}); {}",
      pair.photographed_rows->median_px, pair.photographed_rows->percentile_95_px, pair.rows->median_px,
      pair.rows->percentile_95_px, kept);
}

std::string area_warning(const PreparedPair& pair) {
  constexpr double most_lost = 0.1;
  if (!pair.rectification) return {};
  const double lost = 1 - kept_area(*pair.rectification);
  if (lost <= most_lost) return {};
  return fmt::format(
      "rectifying cuts off {:.0f} % of the photographs' area; --rectify never keeps all of it, with rows that differ",
      100 * lost);
}

std::string row_warning(const PreparedPair& pair) {
  if (!pair.rows || rows_fit(*pair.rows, pair.tolerated)) return {};
  const std::string rows = fmt::format(
      "rows differ by {:.1f} pixels (median; 95th percentile {:.1f}), expected at most {:.3g} ({:.3g})",
      pair.rows->median_px, pair.rows->percentile_95_px, pair.tolerated.median_px, pair.tolerated.percentile_95_px);
  if (pair.rectification) return fmt::format("after rectification, {}; disparities may be wrong", rows);
  if (!pair.why_not_rectified.empty())
    return fmt::format("the pictures are not rectified: their {}, and rectifying them failed: {}", rows,
                       pair.why_not_rectified);
  return fmt::format("the pictures are not rectified: their {}; rectify them with 'wheatstone rectify'", rows);
}

}  // namespace wheatstone
