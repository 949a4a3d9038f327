#include <fmt/format.h>

#include <cmath>
#include <opencv2/core/persistence.hpp>
#include <optional>

#include "wheatstone/calibration/calibration_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = 4 << 20;
constexpr int most_side_px = 1 << 16;

/// Reads named values and says of each what is wrong with it.
class CalibrationReader {
 public:
  CalibrationReader(std::string file, const cv::FileStorage& storage) : file_(std::move(file)), storage_(storage) {}

  bool has(const char* name) const { return !storage_[name].empty(); }

  /// The numbers of a matrix, whatever its type. The rows and columns that the file claims are not trusted with memory.
  std::vector<double> numbers(const char* name) const {
    const cv::FileNode node = storage_[name];
    if (node.empty()) refuse(fmt::format("'{}' is missing", name));
    const cv::FileNode data = node.isMap() ? node["data"] : node;
    if (!data.isSeq()) refuse(fmt::format("'{}' is not a matrix", name));
    std::vector<double> values;
    for (const cv::FileNode element : data) {
      if (!element.isReal() && !element.isInt())
        refuse(fmt::format("'{}' contains a value that is not a number", name));
      values.push_back(static_cast<double>(element));
      if (!std::isfinite(values.back())) refuse(fmt::format("'{}' contains a number that is not finite", name));
    }
    return values;
  }

  template <std::size_t count>
  void read(const char* name, std::array<double, count>& into) const {
    const std::vector<double> values = numbers(name);
    if (values.size() != count) refuse(fmt::format("'{}' has {} numbers, expected {}", name, values.size(), count));
    std::ranges::copy(values, into.begin());
  }

  int side(const char* name) const {
    const cv::FileNode node = storage_[name];
    if (node.empty()) refuse(fmt::format("'{}' is missing", name));
    const bool sane = node.isInt() && static_cast<int>(node) > 0 && static_cast<int>(node) <= most_side_px;
    if (!sane) refuse(fmt::format("'{}' is not a valid picture size", name));
    return static_cast<int>(node);
  }

  CameraModel camera(const char* matrix_name, const char* distortion_name) const {
    CameraModel camera;
    read(matrix_name, camera.matrix);
    if (!(camera.matrix[0] > 0) || !(camera.matrix[4] > 0))
      refuse(fmt::format("'{}' has no positive focal length", matrix_name));
    camera.distortion = numbers(distortion_name);
    constexpr std::array<std::size_t, 6> lengths{0, 4, 5, 8, 12, 14};
    if (std::ranges::find(lengths, camera.distortion.size()) == lengths.end())
      refuse(fmt::format("'{}' has {} numbers, expected 4, 5, 8, 12 or 14", distortion_name, camera.distortion.size()));
    return camera;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}, expected a calibration of two cameras", file_, why));
  }

 private:
  std::string file_;
  const cv::FileStorage& storage_;
};

void read_size(const CalibrationReader& reader, StereoCalibration& calibration) {
  if (reader.has("imageSize") && !reader.has("image_width")) {
    std::array<double, 2> size{};
    reader.read("imageSize", size);
    if (!(size[0] >= 1 && size[0] <= most_side_px && size[1] >= 1 && size[1] <= most_side_px))
      reader.refuse("'imageSize' is not a valid picture size");
    calibration.width = static_cast<int>(size[0]);
    calibration.height = static_cast<int>(size[1]);
    return;
  }
  calibration.width = reader.side("image_width");
  calibration.height = reader.side("image_height");
}

StereoCalibration read_from(const CalibrationReader& reader) {
  StereoCalibration calibration;
  read_size(reader, calibration);
  calibration.left = reader.camera("cameraMatrix1", "distCoeffs1");
  calibration.right = reader.camera("cameraMatrix2", "distCoeffs2");
  reader.read("R", calibration.rotation);
  reader.read("T", calibration.translation);
  const cv::Mat turned_back = as_matrix(calibration.rotation, 3) * as_matrix(calibration.rotation, 3).t();
  if (cv::norm(turned_back - cv::Mat::eye(3, 3, CV_64F)) > 1e-3) reader.refuse("'R' is not a rotation matrix");
  const auto& [x, y, z] = calibration.translation;
  if (!(std::abs(x) > std::max(std::abs(y), std::abs(z)))) reader.refuse("'T' is not mainly horizontal");
  if (reader.has("E") && reader.has("F")) {
    reader.read("E", calibration.essential);
    reader.read("F", calibration.fundamental);
  } else {
    add_epipolar_matrices(calibration);
  }
  if (reader.has("R1") && reader.has("R2") && reader.has("P1") && reader.has("P2") && reader.has("Q")) {
    reader.read("R1", calibration.left_rotation);
    reader.read("R2", calibration.right_rotation);
    reader.read("P1", calibration.left_projection);
    reader.read("P2", calibration.right_projection);
    reader.read("Q", calibration.depth_from_disparity);
  } else {
    add_rectification(calibration);
  }
  if (reader.has("reprojection_error")) {
    std::array<double, 1> error{};
    reader.read("reprojection_error", error);
    calibration.reprojection_error_px = error[0];
  }
  return calibration;
}

}  // namespace

void write_stereo_calibration(const std::filesystem::path& path, const StereoCalibration& calibration) {
  cv::FileStorage storage("calibration.yml",
                          cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  storage << "image_width" << calibration.width << "image_height" << calibration.height;
  storage << "cameraMatrix1" << as_matrix(calibration.left.matrix, 3);
  storage << "distCoeffs1" << cv::Mat(calibration.left.distortion, true).reshape(1, 1);
  storage << "cameraMatrix2" << as_matrix(calibration.right.matrix, 3);
  storage << "distCoeffs2" << cv::Mat(calibration.right.distortion, true).reshape(1, 1);
  storage << "R" << as_matrix(calibration.rotation, 3) << "T" << as_matrix(calibration.translation, 3);
  storage << "E" << as_matrix(calibration.essential, 3) << "F" << as_matrix(calibration.fundamental, 3);
  storage << "R1" << as_matrix(calibration.left_rotation, 3) << "R2" << as_matrix(calibration.right_rotation, 3);
  storage << "P1" << as_matrix(calibration.left_projection, 3) << "P2" << as_matrix(calibration.right_projection, 3);
  storage << "Q" << as_matrix(calibration.depth_from_disparity, 4);
  storage << "reprojection_error" << std::vector<double>{calibration.reprojection_error_px};
  write_whole_file(path, storage.releaseAndGetString());
}

StereoCalibration read_stereo_calibration(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, most_bytes);
  const std::string file = path.string();
  const auto no_calibration = [&]() -> Error {
    return {ErrorKind::bad_input, fmt::format("{}: cannot be read as YAML, XML or JSON, expected a calibration of two "
                                              "cameras",
                                              file)};
  };
  try {
    const cv::FileStorage storage(bytes, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (!storage.isOpened()) throw no_calibration();
    return read_from(CalibrationReader(file, storage));
  } catch (const cv::Exception&) {
    throw no_calibration();
  }
}

}  // namespace wheatstone
