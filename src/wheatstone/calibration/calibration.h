#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/calibration/checkerboard.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// A camera as OpenCV describes it, and in its pixels: the centre of the first one is (0, 0), not (½, ½).
struct CameraModel {
  std::array<double, 9> matrix{};  ///< focal lengths and principal point, row by row
  std::vector<double> distortion;  ///< k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [τx τy]]]]
};

/// Two cameras side by side. Matrices go row by row; a point X of the left camera's space is R·X + T in the right
/// one's. Lengths are millimetres. Pixels are OpenCV's, as in CameraModel.
struct StereoCalibration {
  int width = 0;  ///< of the pictures that it holds for
  int height = 0;
  CameraModel left, right;
  std::array<double, 9> rotation{};     ///< R
  std::array<double, 3> translation{};  ///< T, mm: its x is negative unless left and right are swapped
  std::array<double, 9> essential{};    ///< E
  std::array<double, 9> fundamental{};  ///< F

  // How both pictures are turned so that corresponding points share a row.
  std::array<double, 9> left_rotation{}, right_rotation{};       ///< R1, R2
  std::array<double, 12> left_projection{}, right_projection{};  ///< P1, P2
  std::array<double, 16> depth_from_disparity{};                 ///< Q

  double reprojection_error_px = 0;  ///< root mean square over all corners of both views
};

/// True where the pictures called left are those of the camera on the right: near things have negative disparities, and
/// shown as it is the pair would turn depth inside out.
bool eyes_swapped(const StereoCalibration& calibration);

struct CalibrationOptions {
  double worst_to_median = 3;  ///< a pair whose error is above the median by more than this factor is dropped
};

/// What became of one pair of pictures.
struct CalibrationPair {
  std::string left_name, right_name;
  bool used = false;
  std::string why_not;       ///< empty where it was used
  double left_error_px = 0;  ///< root mean square of the corners' reprojection, where the board was found in both
  double right_error_px = 0;
};

struct CalibrationResult {
  StereoCalibration calibration;
  std::vector<CalibrationPair> pairs;  ///< one a sighting, in their order
  double row_difference_px = 0;        ///< median over all used corners: how far rows differ after rectification
};

/// Calibrates a rig from sightings of one board: each camera on its own (Zhang 2000), then both together. Pairs without
/// the board, and those whose error stands far above the median, are left out and named in the result.
/// Throws Error{bad_input}: no board in any pair; fewer than 3 good pairs; pairs of different sizes; the cameras do
/// not stand side by side.
CalibrationResult calibrate(std::span<const BoardSighting> sightings, const Checkerboard& board,
                            const CalibrationOptions& options = {}, const Progress& progress = {});

/// Writes a YAML file that OpenCV's FileStorage reads, under OpenCV's usual names: image_width, image_height,
/// cameraMatrix1, distCoeffs1, cameraMatrix2, distCoeffs2, R, T, E, F, R1, R2, P1, P2, Q. Throws
/// Error{cannot_read_write}.
void write_stereo_calibration(const std::filesystem::path& path, const StereoCalibration& calibration);

/// Reads such a file, YAML, XML or JSON, ours or another program's. What is not there but follows from R and T (E, F,
/// R1, R2, P1, P2, Q) is made. Throws Error{bad_input}, naming the file and what it lacks or has wrong.
StereoCalibration read_stereo_calibration(const std::filesystem::path& path);

}  // namespace wheatstone
