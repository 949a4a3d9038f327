#include "wheatstone/calibration/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "wheatstone/calibration/calibration_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/percentile.h"

namespace wheatstone {
namespace {

using Corners = std::vector<std::vector<cv::Point2f>>;

constexpr std::size_t least_pairs = 3;
constexpr int most_rounds = 6;

std::vector<cv::Point2f> in_opencv_pixels(const std::vector<PicturePoint>& points) {
  std::vector<cv::Point2f> result;
  result.reserve(points.size());
  for (const PicturePoint& point : points)
    result.emplace_back(static_cast<float>(point.x - 0.5), static_cast<float>(point.y - 0.5));
  return result;
}

std::vector<cv::Point3f> corners_of(const Checkerboard& board) {
  std::vector<cv::Point3f> corners;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      corners.emplace_back(static_cast<float>(column * board.square_mm), static_cast<float>(row * board.square_mm),
                           0.f);
  return corners;
}

/// What the board looked like to both cameras, and how well that was explained.
struct Observations {
  std::vector<std::size_t> pairs;  ///< which of the sightings
  std::vector<std::vector<cv::Point3f>> board;
  Corners left, right;
  std::vector<double> left_error, right_error;
};

Observations observed(std::span<const BoardSighting> sightings, const Checkerboard& board,
                      const std::vector<CalibrationPair>& pairs) {
  Observations all;
  const std::vector<cv::Point3f> corners = corners_of(board);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!pairs[i].used) continue;
    all.pairs.push_back(i);
    all.board.push_back(corners);
    all.left.push_back(in_opencv_pixels(sightings[i].left));
    all.right.push_back(in_opencv_pixels(sightings[i].right));
  }
  return all;
}

/// Where each camera sees the board, a rotation and a translation a pair.
struct Poses {
  std::vector<cv::Mat> rotations, translations;
};

struct CameraOnItsOwn {
  cv::Mat matrix, distortion;
  Poses board;
};

CameraOnItsOwn calibrate_camera(const Observations& seen, const Corners& corners, cv::Size size) {
  CameraOnItsOwn camera;
  cv::calibrateCamera(seen.board, corners, size, camera.matrix, camera.distortion, camera.board.rotations,
                      camera.board.translations);
  return camera;
}

void calibrate_rig(Observations& seen, cv::Size size, StereoCalibration& calibration) {
  CameraOnItsOwn left = calibrate_camera(seen, seen.left, size), right = calibrate_camera(seen, seen.right, size);
  cv::Mat rotation, translation, essential, fundamental, errors;
  calibration.reprojection_error_px =
      cv::stereoCalibrate(seen.board, seen.left, seen.right, left.matrix, left.distortion, right.matrix,
                          right.distortion, size, rotation, translation, essential, fundamental, errors,
                          cv::CALIB_USE_INTRINSIC_GUESS, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-7});
  calibration.width = size.width;
  calibration.height = size.height;
  copy_numbers(left.matrix, calibration.left.matrix);
  copy_numbers(right.matrix, calibration.right.matrix);
  calibration.left.distortion.assign(left.distortion.begin<double>(), left.distortion.end<double>());
  calibration.right.distortion.assign(right.distortion.begin<double>(), right.distortion.end<double>());
  copy_numbers(rotation, calibration.rotation);
  copy_numbers(translation, calibration.translation);
  copy_numbers(essential, calibration.essential);
  copy_numbers(fundamental, calibration.fundamental);
  seen.left_error.clear();
  seen.right_error.clear();
  for (int i = 0; i < errors.rows; ++i) {
    seen.left_error.push_back(errors.at<double>(i, 0));
    seen.right_error.push_back(errors.at<double>(i, 1));
  }
}

/// How well one pair's left pose and the rig's geometry that another pair stands for explain where the right camera saw
/// the corners: root mean square, in pixels.
double right_error(const Observations& seen, const CameraOnItsOwn& left, const CameraOnItsOwn& right, std::size_t pair,
                   std::size_t rig) {
  const auto rotation = [](const CameraOnItsOwn& camera, std::size_t i) {
    cv::Matx33d matrix;
    cv::Rodrigues(camera.board.rotations[i], matrix);
    return matrix;
  };
  const auto translation = [](const CameraOnItsOwn& camera, std::size_t i) {
    return cv::Vec3d(camera.board.translations[i]);
  };
  const cv::Matx33d turn = rotation(right, rig) * rotation(left, rig).t();
  const cv::Vec3d shift = translation(right, rig) - turn * translation(left, rig);
  cv::Vec3d pose;
  cv::Rodrigues(turn * rotation(left, pair), pose);
  std::vector<cv::Point2f> expected;
  cv::projectPoints(seen.board[pair], pose, turn * translation(left, pair) + shift, right.matrix, right.distortion,
                    expected);
  return cv::norm(expected, seen.right[pair], cv::NORM_L2) / std::sqrt(static_cast<double>(expected.size()));
}

/// A pair whose pictures do not belong together would spoil the rig for all. Each pair in turn says where the cameras
/// stand; the one that most others agree with is believed, and those that do not agree are marked.
void drop_strangers(const Observations& seen, cv::Size size, std::vector<CalibrationPair>& pairs) {
  const CameraOnItsOwn left = calibrate_camera(seen, seen.left, size), right = calibrate_camera(seen, seen.right, size);
  std::vector<double> best;
  for (std::size_t rig = 0; rig < seen.pairs.size(); ++rig) {
    std::vector<double> errors;
    for (std::size_t pair = 0; pair < seen.pairs.size(); ++pair)
      errors.push_back(right_error(seen, left, right, pair, rig));
    if (best.empty() || percentile(errors, 0.5) < percentile(best, 0.5)) best = std::move(errors);
  }
  // One pair on its own decides a rig badly: only what is far off is strange.
  constexpr double least_px = 5, worst_to_median = 6;
  const double limit = std::max(least_px, worst_to_median * percentile(best, 0.5));
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i] <= limit) continue;
    CalibrationPair& pair = pairs[seen.pairs[i]];
    pair.used = false;
    pair.right_error_px = best[i];
    pair.why_not = fmt::format(
        "its corner error is {:.0f} px (median of all pairs: {:.2f}): the two pictures were not taken at the same "
        "time, or the rig was moved",
        best[i], percentile(best, 0.5));
  }
}

/// Marks pairs that stand out; false where none does, or too few would be left.
bool drop_outliers(const Observations& seen, const CalibrationOptions& options, std::vector<CalibrationPair>& pairs) {
  std::vector<double> worst;
  for (std::size_t i = 0; i < seen.pairs.size(); ++i) {
    worst.push_back(std::max(seen.left_error[i], seen.right_error[i]));
    pairs[seen.pairs[i]].left_error_px = seen.left_error[i];
    pairs[seen.pairs[i]].right_error_px = seen.right_error[i];
  }
  // A tenth of a pixel is as good as corners are found; nothing below it is an outlier.
  const double usual = std::max(percentile(worst, 0.5), 0.1);
  const double limit = options.worst_to_median * usual;
  std::size_t left_over = seen.pairs.size();
  for (const double error : worst) left_over -= error > limit ? 1 : 0;
  if (left_over == seen.pairs.size() || left_over < least_pairs) return false;
  for (std::size_t i = 0; i < worst.size(); ++i) {
    if (worst[i] <= limit) continue;
    pairs[seen.pairs[i]].used = false;
    pairs[seen.pairs[i]].why_not =
        fmt::format("its corner error is {:.2f} px (median of all pairs: {:.2f})", worst[i], usual);
  }
  return true;
}

std::vector<CalibrationPair> first_choice(std::span<const BoardSighting> sightings, const Checkerboard& board) {
  const std::size_t corners = static_cast<std::size_t>(board.columns) * board.rows;
  std::vector<CalibrationPair> pairs;
  for (const BoardSighting& sighting : sightings) {
    CalibrationPair pair{sighting.left_name, sighting.right_name};
    const bool left = sighting.left.size() == corners, right = sighting.right.size() == corners;
    pair.used = left && right;
    if (!left && !right) pair.why_not = "no board found in either picture";
    if (left && !right) pair.why_not = "no board found in the right picture";
    if (!left && right) pair.why_not = "no board found in the left picture";
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

void check(std::span<const BoardSighting> sightings, const std::vector<CalibrationPair>& pairs,
           const Checkerboard& board) {
  const auto good = static_cast<std::size_t>(std::ranges::count_if(pairs, &CalibrationPair::used));
  if (good == 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("no checkerboard of {}x{} inner corners found in any of {} pairs of pictures",
                            board.columns, board.rows, pairs.size()));
  if (good < least_pairs)
    throw Error(ErrorKind::bad_input,
                fmt::format("only {} of {} pairs are consistent with one rig, expected at least {}", good, pairs.size(),
                            least_pairs));
  for (const BoardSighting& sighting : sightings)
    if (sighting.width != sightings[0].width || sighting.height != sightings[0].height)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", sighting.left_name, sighting.width,
                              sighting.height, sightings[0].width, sightings[0].height, sightings[0].left_name));
}

void check_arrangement(const StereoCalibration& calibration) {
  const auto [x, y, z] = calibration.translation;
  if (std::abs(x) < std::max(std::abs(y), std::abs(z)))
    throw Error(ErrorKind::bad_input,
                fmt::format("the right camera is at ({:.1f}, {:.1f}, {:.1f}) mm relative to the left one, expected a "
                            "mainly horizontal offset: the cameras of a rig stand side by side",
                            -x, -y, -z));
}

double row_difference(const Observations& seen, const StereoCalibration& calibration) {
  const auto rectified = [](const std::vector<cv::Point2f>& corners, const CameraModel& camera,
                            const std::array<double, 9>& rotation, const std::array<double, 12>& projection) {
    std::vector<cv::Point2f> result;
    cv::undistortPoints(corners, result, as_matrix(camera.matrix, 3), camera.distortion, as_matrix(rotation, 3),
                        as_matrix(projection, 3));
    return result;
  };
  std::vector<double> differences;
  for (std::size_t i = 0; i < seen.left.size(); ++i) {
    const auto left = rectified(seen.left[i], calibration.left, calibration.left_rotation, calibration.left_projection);
    const auto right =
        rectified(seen.right[i], calibration.right, calibration.right_rotation, calibration.right_projection);
    for (std::size_t corner = 0; corner < left.size(); ++corner)
      differences.push_back(std::abs(static_cast<double>(left[corner].y) - static_cast<double>(right[corner].y)));
  }
  return percentile(std::move(differences), 0.5);
}

}  // namespace

bool eyes_swapped(const StereoCalibration& calibration) { return calibration.translation[0] > 0; }

void add_epipolar_matrices(StereoCalibration& calibration) {
  const auto [x, y, z] = calibration.translation;
  const cv::Matx33d across(0, -z, y, z, 0, -x, -y, x, 0);
  const cv::Mat essential = cv::Mat(across) * as_matrix(calibration.rotation, 3);
  copy_numbers(essential, calibration.essential);
  cv::Mat fundamental =
      as_matrix(calibration.right.matrix, 3).inv().t() * essential * as_matrix(calibration.left.matrix, 3).inv();
  const double last = fundamental.at<double>(2, 2);
  if (std::abs(last) > 1e-15) fundamental /= last;
  copy_numbers(fundamental, calibration.fundamental);
}

void add_rectification(StereoCalibration& calibration) {
  cv::Mat left_rotation, right_rotation, left_projection, right_projection, depth;
  constexpr double only_valid_pixels = 0;
  cv::stereoRectify(as_matrix(calibration.left.matrix, 3), calibration.left.distortion,
                    as_matrix(calibration.right.matrix, 3), calibration.right.distortion,
                    {calibration.width, calibration.height}, as_matrix(calibration.rotation, 3),
                    as_matrix(calibration.translation, 3), left_rotation, right_rotation, left_projection,
                    right_projection, depth, cv::CALIB_ZERO_DISPARITY, only_valid_pixels);
  copy_numbers(left_rotation, calibration.left_rotation);
  copy_numbers(right_rotation, calibration.right_rotation);
  copy_numbers(left_projection, calibration.left_projection);
  copy_numbers(right_projection, calibration.right_projection);
  copy_numbers(depth, calibration.depth_from_disparity);
}

CalibrationResult calibrate(std::span<const BoardSighting> sightings, const Checkerboard& board,
                            const CalibrationOptions& options, const Progress& progress) {
  CalibrationResult result;
  result.pairs = first_choice(sightings, board);
  check(sightings, result.pairs, board);
  const cv::Size size(sightings[0].width, sightings[0].height);
  Observations seen = observed(sightings, board, result.pairs);
  try {
    drop_strangers(seen, size, result.pairs);
    check(sightings, result.pairs, board);
    for (int round = 0; round < most_rounds; ++round) {
      report(progress, "calibrating", static_cast<double>(round) / most_rounds);
      seen = observed(sightings, board, result.pairs);
      calibrate_rig(seen, size, result.calibration);
      if (!drop_outliers(seen, options, result.pairs)) break;
    }
  } catch (const cv::Exception&) {
    throw Error(ErrorKind::bad_input, fmt::format("the board's positions in {} pairs do not determine the cameras, "
                                                  "expected a board tilted in several directions",
                                                  seen.pairs.size()));
  }
  check_arrangement(result.calibration);
  add_rectification(result.calibration);
  result.row_difference_px = row_difference(seen, result.calibration);
  report(progress, "calibrating", 1);
  return result;
}

}  // namespace wheatstone
