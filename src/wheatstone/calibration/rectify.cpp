#include "wheatstone/calibration/rectify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/calibration/calibration_internal.h"
#include "wheatstone/calibration/common_window_internal.h"
#include "wheatstone/calibration/rectifying_turn_internal.h"
#include "wheatstone/calibration/vertical_disparity_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/matching/match_features.h"
#include "wheatstone/percentile.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {
namespace {

constexpr int least_features = 40;
constexpr std::size_t least_inliers = 24;
constexpr int least_side_px = 16;

/// A picture brought to the turned camera, and 255 where the photograph covers it.
struct TurnedPicture {
  cv::Mat picture, covered;
};

void check(const StereoPair& pair) {
  check_fits(pair);
  if (pair.left.width() < least_side_px || pair.left.height() < least_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("the pictures are {}x{} pixels, expected at least {}x{}",
                                                  pair.left.width(), pair.left.height(), least_side_px, least_side_px));
}

cv::Size size_of(const StereoPair& pair) { return {pair.left.width(), pair.left.height()}; }

/// Every fifth match is kept aside to measure with.
struct SplitMatches {
  std::vector<FeatureMatch> deciding, measuring;
};

SplitMatches split(std::span<const FeatureMatch> matches) {
  SplitMatches result;
  for (std::size_t i = 0; i < matches.size(); ++i)
    (i % 5 == 2 ? result.measuring : result.deciding).push_back(matches[i]);
  return result;
}

std::vector<FeatureMatch> fitting(std::span<const FeatureMatch> matches, const std::array<double, 9>& fundamental,
                                  double tolerance_px) {
  std::vector<FeatureMatch> result;
  for (const FeatureMatch& match : matches)
    if (std::abs(sampson_distance(fundamental, match)) <= tolerance_px) result.push_back(match);
  return result;
}

void check_features(const FeatureMatches& features) {
  const auto& [matches, left, right] = features;
  if (std::min(left, right) < least_features)
    throw Error(ErrorKind::bad_input,
                fmt::format("the {} picture has only {} distinct points, expected at least {}: it has too little "
                            "texture or is too blurred",
                            left < right ? "left" : "right", std::min(left, right), least_features));
  if (matches.size() < least_inliers)
    throw Error(ErrorKind::bad_input, fmt::format("of {} and {} distinct points only {} match, expected at least {}: "
                                                  "the two pictures do not show the same scene",
                                                  left, right, matches.size(), least_inliers));
}

/// Pictures of different scenes have matches too, and the geometry that most of these happen to agree with has inliers;
/// but they are few against the features, and of few of the matches.
bool shows_one_scene(const EpipolarGeometry& geometry, std::size_t matches, const FeatureMatches& features) {
  constexpr double least_share_of_matches = 0.5, least_share_of_features = 0.02;
  const auto inliers = static_cast<double>(geometry.inliers.size());
  const double asked_share = static_cast<double>(matches) / static_cast<double>(features.matches.size());
  return geometry.inliers.size() >= least_inliers && inliers >= least_share_of_matches * static_cast<double>(matches) &&
         inliers >= least_share_of_features * asked_share * std::min(features.left_features, features.right_features);
}

void check_geometry(const EpipolarGeometry& geometry, std::size_t matches, const FeatureMatches& features) {
  const std::size_t inliers = geometry.inliers.size();
  if (!shows_one_scene(geometry, matches, features))
    throw Error(ErrorKind::bad_input, fmt::format("only {} of {} matched points (of {} and {} distinct points) fit one "
                                                  "epipolar geometry: the two pictures do not show the same scene",
                                                  inliers, matches, features.left_features, features.right_features));
  const int least_off_plane = std::max(12, static_cast<int>(0.02 * static_cast<double>(inliers)));
  if (geometry.off_plane < least_off_plane)
    throw Error(ErrorKind::bad_input,
                "the camera positions cannot be determined, because the scene is flat or too far away, or both "
                "pictures were taken from the same position: expected a pair with depth, or a calibration");
}

/// The corners of the picture where they are taken to; refuses what turns a picture beyond recognition.
std::vector<cv::Point2d> carried_corners(const cv::Matx33d& homography, cv::Size size) {
  std::vector<cv::Point2d> corners;
  const double width = size.width, height = size.height;
  bool sane = true;
  for (const PicturePoint& corner : {PicturePoint{0, 0}, {width, 0}, {width, height}, {0, height}}) {
    sane = sane && homography(2, 0) * corner.x + homography(2, 1) * corner.y + homography(2, 2) > 0.2;
    corners.push_back(carried(homography, corner));
  }
  const std::vector<cv::Point2f> outline(corners.begin(), corners.end());
  const double growth = std::abs(cv::contourArea(outline)) / (width * height);
  if (!sane || !(growth > 0.4 && growth < 2.5))
    throw Error(ErrorKind::bad_input,
                "the cameras' directions differ too much, or the camera moved forwards: expected two cameras side by "
                "side that look in the same direction");
  return corners;
}

struct Estimate {
  RectifyingTurn turn;
  std::vector<FeatureMatch> deciding, measuring;
};

Estimate estimate(const StereoPair& pair, const Progress& progress) {
  const cv::Size size = size_of(pair);
  const double tolerance = epipolar_tolerance_px(std::max(size.width, size.height));
  report(progress, "matching features", 0);
  const FeatureMatches features = match_features(pair.left, pair.right);
  check_features(features);
  report(progress, "estimating the cameras", 0.5);
  const SplitMatches matches = split(features.matches);
  const EpipolarGeometry geometry = find_epipolar_geometry(matches.deciding, tolerance);
  check_geometry(geometry, matches.deciding.size(), features);

  Estimate found;
  found.turn = find_rectifying_turn(geometry.inliers, size);
  found.deciding = fitting(matches.deciding, found.turn.fundamental, 1.5 * tolerance);
  if (found.deciding.size() < std::max<std::size_t>(least_inliers, geometry.inliers.size() / 2))
    throw Error(ErrorKind::bad_input,
                "no camera rotation brings matching points to the same rows: expected two cameras side by side that "
                "look in the same direction");
  found.turn = find_rectifying_turn(found.deciding, size);
  settle_rows(found.turn, found.deciding, size);
  // Wider than what decided, so that what fits badly is seen; without a limit wrong matches would be all that is seen.
  found.measuring = fitting(matches.measuring, found.turn.fundamental, 4 * tolerance);
  return found;
}

std::vector<FeatureMatch> carried_matches(const RectifyingTurn& turn, std::span<const FeatureMatch> matches) {
  std::vector<FeatureMatch> result;
  for (const FeatureMatch& match : matches) {
    const cv::Point2d left = carried(turn.left, match.left), right = carried(turn.right, match.right);
    result.push_back({{left.x, left.y}, {right.x, right.y}});
  }
  return result;
}

/// What must be added to all disparities so that the farthest match's is not below 0, with some room for what is
/// farther still.
double shift_for(std::span<const FeatureMatch> matches, cv::Size size) {
  std::vector<double> disparities;
  for (const FeatureMatch& match : matches) disparities.push_back(match.left.x - match.right.x);
  const double room = std::max(2.0, 0.01 * size.width);
  const double least = percentile(std::move(disparities), 0.01);
  return least < 0 ? std::ceil(room - least) : 0;
}

/// Moves both turned pictures so that all that may be common to them begins at (0, 0); returns its size.
cv::Size fit_canvas(RectifyingTurn& turn, cv::Size size) {
  const std::vector<cv::Point2d> left = carried_corners(turn.left, size), right = carried_corners(turn.right, size);
  const auto extent = [](const std::vector<cv::Point2d>& corners, double cv::Point2d::*axis) {
    const auto [low, high] = std::ranges::minmax(corners, {}, axis);
    return std::pair{low.*axis, high.*axis};
  };
  const auto common = [&](double cv::Point2d::*axis) {
    const auto [left_low, left_high] = extent(left, axis);
    const auto [right_low, right_high] = extent(right, axis);
    return std::pair{std::floor(std::max(left_low, right_low)), std::ceil(std::min(left_high, right_high))};
  };
  const auto [x_low, x_high] = common(&cv::Point2d::x);
  const auto [y_low, y_high] = common(&cv::Point2d::y);
  const cv::Matx33d move(1, 0, -x_low, 0, 1, -y_low, 0, 0, 1);
  turn.left = move * turn.left;
  turn.right = move * turn.right;
  return {std::max(static_cast<int>(x_high - x_low), 0), std::max(static_cast<int>(y_high - y_low), 0)};
}

TurnedPicture turned(const Image<Rgb8>& picture, const cv::Matx33d& homography, cv::Size canvas) {
  // OpenCV counts from the centre of the first pixel.
  const cv::Matx33d half(1, 0, 0.5, 0, 1, 0.5, 0, 0, 1), back(1, 0, -0.5, 0, 1, -0.5, 0, 0, 1);
  const cv::Matx33d in_opencv = back * homography * half;
  TurnedPicture result;
  cv::warpPerspective(as_mat(picture), result.picture, in_opencv, canvas, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  const cv::Mat all(picture.height(), picture.width(), CV_8UC1, cv::Scalar(255));
  cv::warpPerspective(all, result.covered, in_opencv, canvas, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return result;
}

Image<Rgb8> cut(const cv::Mat& picture, const cv::Rect& window) {
  Image<Rgb8> result(window.width, window.height);
  picture(window).copyTo(as_mat(result));
  return result;
}

cv::Rect common_window(const TurnedPicture& left, const TurnedPicture& right) {
  const cv::Rect window = largest_rectangle_within(left.covered & right.covered);
  if (std::min(window.width, window.height) < least_side_px)
    throw Error(ErrorKind::bad_input, "the two rectified pictures have no common area");
  return window;
}

void match_colours(RectifiedPair& result, std::span<const FeatureMatch> matches) {
  result.colour = find_colour_transfer(result.pictures.left, result.pictures.right, matches);
  if (result.colour) apply_colour_transfer(*result.colour, result.pictures.right);
}

TurnedPicture undistorted(const Image<Rgb8>& picture, const CameraModel& camera, const std::array<double, 9>& rotation,
                          const std::array<double, 12>& projection) {
  cv::Mat from_x, from_y;
  const cv::Size size(picture.width(), picture.height());
  cv::initUndistortRectifyMap(as_matrix(camera.matrix, 3), camera.distortion, as_matrix(rotation, 3),
                              as_matrix(projection, 3), size, CV_32FC1, from_x, from_y);
  TurnedPicture result;
  cv::remap(as_mat(picture), result.picture, from_x, from_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  const cv::Mat all(size, CV_8UC1, cv::Scalar(255));
  cv::remap(all, result.covered, from_x, from_y, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return result;
}

PicturePoint undistorted(const PicturePoint& point, const CameraModel& camera, const std::array<double, 9>& rotation,
                         const std::array<double, 12>& projection, const cv::Rect& window) {
  const std::vector<cv::Point2d> from{{point.x - 0.5, point.y - 0.5}};
  std::vector<cv::Point2d> to;
  cv::undistortPoints(from, to, as_matrix(camera.matrix, 3), camera.distortion, as_matrix(rotation, 3),
                      as_matrix(projection, 3));
  return {to[0].x + 0.5 - window.x, to[0].y + 0.5 - window.y};
}

/// Measures a calibrated pair by its features, where it has enough of them, and returns those in the new picture.
std::vector<FeatureMatch> measure(const StereoPair& photographs, const StereoCalibration& calibration,
                                  const cv::Rect& window, RectifiedPair& result) {
  const FeatureMatches features = match_features(photographs.left, photographs.right);
  const double tolerance = 2 * epipolar_tolerance_px(std::max(photographs.left.width(), photographs.left.height()));
  const EpipolarGeometry geometry = find_epipolar_geometry(features.matches, tolerance);
  if (features.matches.empty() || !shows_one_scene(geometry, features.matches.size(), features)) return {};
  std::vector<FeatureMatch> after;
  for (const FeatureMatch& match : geometry.inliers)
    after.push_back(
        {undistorted(match.left, calibration.left, calibration.left_rotation, calibration.left_projection, window),
         undistorted(match.right, calibration.right, calibration.right_rotation, calibration.right_projection,
                     window)});
  result.measured_matches = static_cast<int>(after.size());
  result.before = vertical_disparity(geometry.inliers);
  result.after = vertical_disparity(after);
  const double most_px = 4 * tolerance;
  if (result.after.median_px > most_px)
    throw Error(ErrorKind::bad_input, fmt::format("rows still differ by {:.1f} px after rectification: the calibration "
                                                  "belongs to another rig, or the rig was moved after calibration",
                                                  result.after.median_px));
  return after;
}

}  // namespace

RectifiedPair rectify(const StereoPair& photographs, const RectifyOptions& options, const Progress& progress) {
  check(photographs);
  const cv::Size size = size_of(photographs);
  Estimate found = estimate(photographs, progress);
  report(progress, "rectifying", 0.8);
  RectifiedPair result;
  result.shift_px = shift_for(carried_matches(found.turn, found.deciding), size);
  found.turn.right = cv::Matx33d(1, 0, -result.shift_px, 0, 1, 0, 0, 0, 1) * found.turn.right;

  const cv::Size canvas = fit_canvas(found.turn, size);
  if (canvas.empty()) throw Error(ErrorKind::bad_input, "the two rectified pictures have no common area");
  const TurnedPicture left = turned(photographs.left, found.turn.left, canvas);
  const TurnedPicture right = turned(photographs.right, found.turn.right, canvas);
  const cv::Rect window = common_window(left, right);
  result.pictures = {cut(left.picture, window), cut(right.picture, window)};

  const cv::Matx33d move(1, 0, -window.x, 0, 1, -window.y, 0, 0, 1);
  found.turn.left = move * found.turn.left;
  found.turn.right = move * found.turn.right;
  result.homographies.emplace();
  std::copy_n(found.turn.left.val, 9, result.homographies->left.begin());
  std::copy_n(found.turn.right.val, 9, result.homographies->right.begin());
  result.measured_matches = static_cast<int>(found.measuring.size());
  result.before = vertical_disparity(found.measuring);
  result.after = vertical_disparity(carried_matches(found.turn, found.measuring));
  if (options.match_colour) match_colours(result, carried_matches(found.turn, found.deciding));
  report(progress, "rectifying", 1);
  return result;
}

RectifiedPair rectify(const StereoPair& photographs, const StereoCalibration& calibration,
                      const RectifyOptions& options, const Progress& progress) {
  check(photographs);
  if (photographs.left.width() != calibration.width || photographs.left.height() != calibration.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("the pictures are {}x{} pixels, expected the calibration's {}x{}", photographs.left.width(),
                            photographs.left.height(), calibration.width, calibration.height));
  report(progress, "rectifying", 0);
  const TurnedPicture left =
      undistorted(photographs.left, calibration.left, calibration.left_rotation, calibration.left_projection);
  const TurnedPicture right =
      undistorted(photographs.right, calibration.right, calibration.right_rotation, calibration.right_projection);
  const cv::Rect window = common_window(left, right);
  RectifiedPair result;
  result.eyes_swapped = eyes_swapped(calibration);
  result.pictures = {cut(left.picture, window), cut(right.picture, window)};
  report(progress, "measuring", 0.3);
  const std::vector<FeatureMatch> matches = measure(photographs, calibration, window, result);
  if (options.match_colour) match_colours(result, matches);
  report(progress, "measuring", 1);
  return result;
}

}  // namespace wheatstone
