#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/calibration/calibration_internal.h"
#include "wheatstone/calibration/rectify_internal.h"
#include "wheatstone/calibration/warp_picture_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// A picture brought to the turned camera, and 255 where the photograph covers it.
struct TurnedPicture {
  cv::Mat picture, covered;
};

Image<Rgb8> cut(const cv::Mat& picture, const cv::Rect& window) {
  Image<Rgb8> result(window.width, window.height);
  picture(window).copyTo(as_mat(result));
  return result;
}

cv::Rect common_window(const TurnedPicture& left, const TurnedPicture& right) {
  const cv::Rect window = largest_rectangle_within(left.covered & right.covered);
  if (std::min(window.width, window.height) < least_rectified_side_px)
    throw Error(ErrorKind::bad_input, "the two rectified pictures have no common area");
  return window;
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

RectifiedPair rectify(const StereoPair& photographs, const StereoCalibration& calibration,
                      const RectifyOptions& options, const Progress& progress) {
  check_rectifiable(photographs);
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
