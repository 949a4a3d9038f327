#include "wheatstone/calibration/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/persistence.hpp>

#include "shared_data.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::calibration_test {

constexpr Checkerboard board{9, 6, 25};

/// A rig whose every number is known.
struct Rig {
  cv::Size size{640, 480};
  cv::Matx33d left{700, 0, 322, 0, 705, 236, 0, 0, 1};
  cv::Matx33d right{690, 0, 315, 0, 694, 243, 0, 0, 1};
  cv::Vec<double, 5> left_distortion{-0.12, 0.05, 0.0005, -0.0003, 0};
  cv::Vec<double, 5> right_distortion{-0.10, 0.03, -0.0004, 0.0006, 0};
  cv::Vec3d turn{0.01, 0.04, -0.015};  ///< of the right camera, as a rotation vector
  cv::Vec3d translation{-90, 1.5, 2};  ///< mm
};

/// Rays of a camera a side of a pixel.
constexpr int finer = 2;

/// The rays through every pixel of a camera.
std::vector<cv::Point2d> rays_of(const cv::Matx33d& camera, const cv::Vec<double, 5>& distortion, cv::Size size) {
  std::vector<cv::Point2d> pixels, rays;
  pixels.reserve(static_cast<std::size_t>(size.area()) * finer * finer);
  for (int y = 0; y < size.height * finer; ++y)
    for (int x = 0; x < size.width * finer; ++x) pixels.emplace_back((x + 0.5) / finer - 0.5, (y + 0.5) / finer - 0.5);
  cv::undistortPoints(pixels, rays, camera, distortion);
  return rays;
}

/// Each ray meets the board's plane: black, white or the grey table.
Image<Rgb8> photograph_of_board(const std::vector<cv::Point2d>& rays, const cv::Matx33d& rotation,
                                const cv::Vec3d& translation, cv::Size size) {
  const cv::Vec3d normal(rotation(0, 2), rotation(1, 2), rotation(2, 2));
  Image<float> fine(size.width * finer, size.height * finer);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const cv::Vec3d ray(rays[i].x, rays[i].y, 1);
    const cv::Vec3d place = rotation.t() * (ray * (normal.dot(translation) / normal.dot(ray)) - translation);
    const double u = place[0] / board.square_mm + 1, v = place[1] / board.square_mm + 1;
    float value = 120;
    if (u > -0.8 && v > -0.8 && u < board.columns + 1.8 && v < board.rows + 1.8) value = 235;
    if (u > 0 && v > 0 && u < board.columns + 1 && v < board.rows + 1)
      value = (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? 20.f : 235.f;
    fine.pixels()[i] = value;
  }
  Image<Rgb8> picture(size.width, size.height);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      float sum = 0;
      for (int j = 0; j < finer; ++j)
        for (int i = 0; i < finer; ++i) sum += fine(x * finer + i, y * finer + j);
      const auto value = static_cast<std::uint8_t>(std::lround(sum / (finer * finer)));
      picture(x, y) = {value, value, value};
    }
  }
  return picture;
}

/// The board held before the rig, number `pose` of eight ways.
BoardSighting sighting_of_rendered_board(const Rig& rig, int pose) {
  // Of the one rig there is; they take longer than all the rest.
  static const std::vector<cv::Point2d> left_rays = rays_of(rig.left, rig.left_distortion, rig.size);
  static const std::vector<cv::Point2d> right_rays = rays_of(rig.right, rig.right_distortion, rig.size);
  const double around = 2 * std::numbers::pi * pose / 8;
  cv::Matx33d rotation, right_turn;
  cv::Rodrigues(cv::Vec3d(0.5 * std::cos(around), 0.5 * std::sin(around), 0.08 * (pose % 3 - 1)), rotation);
  cv::Rodrigues(rig.turn, right_turn);
  const cv::Vec3d middle((board.columns - 1) * board.square_mm / 2, (board.rows - 1) * board.square_mm / 2, 0);
  const cv::Vec3d place =
      cv::Vec3d(30 + 60 * std::cos(around * 3), 40 * std::sin(around * 2), 560 + 25 * (pose % 4)) - rotation * middle;
  BoardSighting sighting = find_checkerboards(
      photograph_of_board(left_rays, rotation, place, rig.size),
      photograph_of_board(right_rays, right_turn * rotation, right_turn * place + rig.translation, rig.size), board);
  sighting.left_name = "left_" + std::to_string(pose) + ".png";
  sighting.right_name = "right_" + std::to_string(pose) + ".png";
  return sighting;
}

const std::vector<BoardSighting>& rendered_sightings() {
  static const std::vector<BoardSighting> made = [] {
    std::vector<BoardSighting> sightings;
    for (int pose = 0; pose < 8; ++pose) sightings.push_back(sighting_of_rendered_board({}, pose));
    return sightings;
  }();
  return made;
}

TEST(Calibrate, FindsTheCamerasThatRenderedTheBoard) {
  const Rig rig;
  const CalibrationResult result = calibrate(rendered_sightings(), board);
  const StereoCalibration& found = result.calibration;
  for (const CalibrationPair& pair : result.pairs) EXPECT_TRUE(pair.used) << pair.left_name << pair.why_not;
  EXPECT_LT(found.reprojection_error_px, 0.15);
  EXPECT_LT(result.row_difference_px, 0.05);
  EXPECT_NEAR(found.left.matrix[0], rig.left(0, 0), 3);
  EXPECT_NEAR(found.left.matrix[4], rig.left(1, 1), 3);
  EXPECT_NEAR(found.left.matrix[2], rig.left(0, 2), 3);
  EXPECT_NEAR(found.left.matrix[5], rig.left(1, 2), 3);
  EXPECT_NEAR(found.right.matrix[0], rig.right(0, 0), 3);
  EXPECT_NEAR(found.right.matrix[2], rig.right(0, 2), 3);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.translation[axis], rig.translation[axis], axis == 2 ? 2 : 1) << axis;
  cv::Matx33d turn;
  cv::Rodrigues(rig.turn, turn);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(found.rotation[i], turn.val[i], 0.004) << i;
}

TEST(Calibrate, LeavesOutAndNamesWhatFitsBadly) {
  std::vector<BoardSighting> sightings = rendered_sightings();
  sightings[2].right.clear();
  sightings[5].right = sightings[4].right;
  const CalibrationResult result = calibrate(sightings, board);
  EXPECT_FALSE(result.pairs[2].used);
  EXPECT_EQ(result.pairs[2].why_not, "no board found in the right picture");
  EXPECT_FALSE(result.pairs[5].used);
  EXPECT_THAT(result.pairs[5].why_not, testing::HasSubstr("corner error"));
  EXPECT_GT(result.pairs[5].right_error_px, 5);
  EXPECT_EQ(std::ranges::count_if(result.pairs, &CalibrationPair::used), 6);
  EXPECT_LT(result.calibration.reprojection_error_px, 0.15);
}

TEST(Calibrate, SaysWhatIsWrongWithItsPictures) {
  std::vector<BoardSighting> none(4);
  for (BoardSighting& sighting : none) sighting.width = sighting.height = 100;
  expect_error(ErrorKind::bad_input, "no checkerboard of 9x6 inner corners found in any of 4 pairs",
               [&] { calibrate(none, board); });
  const std::vector<BoardSighting> two(rendered_sightings().begin(), rendered_sightings().begin() + 2);
  expect_error(ErrorKind::bad_input, "only 2 of 2 pairs", [&] { calibrate(two, board); });
  std::vector<BoardSighting> mixed = rendered_sightings();
  mixed[3].width = 320;
  expect_error(ErrorKind::bad_input, "320x480", [&] { calibrate(mixed, board); });
}

TEST(Calibrate, TellsWhenLeftAndRightAreSwapped) {
  std::vector<BoardSighting> swapped = rendered_sightings();
  for (BoardSighting& sighting : swapped) std::swap(sighting.left, sighting.right);
  EXPECT_TRUE(eyes_swapped(calibrate(swapped, board).calibration));
  EXPECT_FALSE(eyes_swapped(calibrate(rendered_sightings(), board).calibration));
}

TEST(FindCheckerboard, RefusesBoardsThatAreNone) {
  const Image<Rgb8> blank(64, 48, {200, 200, 200});
  EXPECT_TRUE(find_checkerboard(blank, board).empty());
  expect_error(ErrorKind::wrong_usage, "2x7", [&] { find_checkerboard(blank, {2, 7, 30}); });
  expect_error(ErrorKind::wrong_usage, "0 mm", [&] { find_checkerboard(blank, {9, 6, 0}); });
}

TEST(CalibrateLong, RectifiesTheRigOfTheSharedPhotographs) {
  const std::filesystem::path folder = shared_data() / "stereo" / "calibration";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder.string();
  std::vector<PictureFiles> files;
  for (int i = 1; i <= 12; ++i) {
    const std::string rest = (i < 10 ? "_0" : "_") + std::to_string(i) + ".png";
    files.push_back({folder / ("left" + rest), folder / ("right" + rest)});
  }
  constexpr Checkerboard printed{11, 7, 30};
  const CalibrationResult result = calibrate(find_checkerboards(files, printed), printed);
  RecordProperty("reprojection_error_px", std::to_string(result.calibration.reprojection_error_px));
  RecordProperty("row_difference_px", std::to_string(result.row_difference_px));
  EXPECT_LE(result.calibration.reprojection_error_px, 0.5);
  EXPECT_LE(result.row_difference_px, 0.3);
  EXPECT_GE(std::ranges::count_if(result.pairs, &CalibrationPair::used), 9);
}

TEST(CalibrationFile, IsReadBackAndByOpenCV) {
  const TemporaryFolder folder;
  const StereoCalibration written = calibrate(rendered_sightings(), board).calibration;
  write_stereo_calibration(folder / "rig.yml", written);
  const StereoCalibration read = read_stereo_calibration(folder / "rig.yml");
  EXPECT_EQ(read.width, 640);
  EXPECT_EQ(read.left.matrix, written.left.matrix);
  EXPECT_EQ(read.right.distortion, written.right.distortion);
  EXPECT_EQ(read.translation, written.translation);
  EXPECT_EQ(read.depth_from_disparity, written.depth_from_disparity);

  const cv::FileStorage storage((folder / "rig.yml").string(), cv::FileStorage::READ);
  for (const char* name : {"cameraMatrix1", "cameraMatrix2", "R", "E", "F", "R1", "R2"}) {
    cv::Mat matrix;
    storage[name] >> matrix;
    EXPECT_EQ(matrix.size(), cv::Size(3, 3)) << name;
  }
  cv::Mat projection;
  storage["P2"] >> projection;
  EXPECT_EQ(projection.size(), cv::Size(4, 3));
}

TEST(CalibrationFile, MakesWhatFollowsFromTheRest) {
  const TemporaryFolder folder;
  const StereoCalibration written = calibrate(rendered_sightings(), board).calibration;
  write_stereo_calibration(folder / "rig.yml", written);
  std::string text = bytes_of(folder / "rig.yml");
  for (const char* name : {"\nE:", "\nR1:", "\nQ:"}) text.insert(text.find(name) + 1, "other_");
  put_bytes(folder / "bare.yml", text);
  const StereoCalibration read = read_stereo_calibration(folder / "bare.yml");
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(read.depth_from_disparity[i], written.depth_from_disparity[i], 1e-6) << i;
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(read.left_rotation[i], written.left_rotation[i], 1e-9) << i;
    EXPECT_NEAR(read.fundamental[i], written.fundamental[i], 1e-6 * std::abs(written.fundamental[i]) + 1e-9) << i;
  }
}

TEST(CalibrationFile, SaysWhatItLacks) {
  const TemporaryFolder folder;
  write_stereo_calibration(folder / "rig.yml", calibrate(rendered_sightings(), board).calibration);
  const std::string text = bytes_of(folder / "rig.yml");
  for (const std::string name : {"cameraMatrix1", "distCoeffs2", "R", "T", "image_width"}) {
    std::string without = text;
    without.insert(without.find("\n" + name + ":") + 1, "other_");
    put_bytes(folder / "lacking.yml", without);
    expect_error(ErrorKind::bad_input, "lacking.yml: '" + name + "' is missing",
                 [&] { read_stereo_calibration(folder / "lacking.yml"); });
  }
  put_bytes(folder / "letter.yml", "Dear Sir, this is a letter.\n");
  put_bytes(folder / "empty.yml", "");
  put_bytes(folder / "cut.yml", text.substr(0, text.size() / 2));
  put_bytes(folder / "huge.yml",
            "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\ncameraMatrix1: !!opencv-matrix\n   rows: 2000000000\n"
            "   cols: 2000000000\n   dt: d\n   data: [ 1., 2. ]\n");
  for (const char* name : {"letter.yml", "empty.yml", "cut.yml", "huge.yml", "missing.yml"})
    expect_error(ErrorKind::bad_input, name, [&] { read_stereo_calibration(folder / name); });
}

}  // namespace wheatstone::calibration_test
