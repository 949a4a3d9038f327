#include "wheatstone/matching/monocular_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/matching/network_inputs_internal.h"
#include "wheatstone/matching/network_picture_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = std::size_t{2} << 30;
constexpr std::int64_t most_side_px = 1 << 14;

[[noreturn]] void refuse(const std::filesystem::path& model, const std::string& why) {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: {}, expected an ONNX network that takes one picture, 1x3xHEIGHTxWIDTH, and gives its "
                          "inverse depth, 1xHEIGHTxWIDTH",
                          model.string(), why));
}

/// A side that the network leaves open keeps the picture's shape, at a size that such networks were trained for.
int side_for(const std::filesystem::path& model, std::int64_t wanted, int picture_px, int shorter_px) {
  constexpr int step = 224, shorter_side = 2 * step, longest_side = 8 * step;
  if (wanted < 0 || wanted > most_side_px) refuse(model, fmt::format("takes pictures {} pixels wide or high", wanted));
  if (wanted > 0) return static_cast<int>(wanted);
  const double scaled = static_cast<double>(shorter_side) * picture_px / shorter_px;
  return std::min(static_cast<int>(std::lround(scaled / step)) * step, longest_side);
}

cv::Size size_for(const std::filesystem::path& model, std::string_view bytes, ImageView<const Rgb8> picture) {
  const std::vector<NetworkInput> inputs = network_inputs(bytes);
  if (inputs.empty()) refuse(model, "is not an ONNX network");
  if (inputs.size() != 1) refuse(model, fmt::format("has {} inputs", inputs.size()));
  const auto& sides = inputs.front().sides;
  if (sides.size() != 4 || sides[0] > 1 || (sides[1] != 3 && sides[1] != 0))
    refuse(model, fmt::format("its input '{}' has another shape", inputs.front().name));
  const int shorter = std::min(picture.width(), picture.height());
  return {side_for(model, sides[3], picture.width(), shorter), side_for(model, sides[2], picture.height(), shorter)};
}

cv::Mat as_input(ImageView<const Rgb8> picture, cv::Size size) {
  cv::Mat sized;
  const bool is_reduced = size.width < picture.width();
  cv::resize(as_mat(picture), sized, size, 0, 0, is_reduced ? cv::INTER_AREA : cv::INTER_CUBIC);
  return network_picture(sized, NetworkValues::imagenet);
}

cv::Mat run(const std::filesystem::path& model, const std::string& bytes, const cv::Mat& input) {
  try {
    cv::dnn::Net network = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    network.setInput(input);
    return network.forward(network.getUnconnectedOutLayersNames().back()).clone();
  } catch (const cv::Exception& error) {
    refuse(model, fmt::format("OpenCV cannot run it ({})", error.err.substr(0, error.err.find('\n'))));
  }
}

}  // namespace

Image<float> depth_by_network(ImageView<const Rgb8> picture, const std::filesystem::path& model) {
  const std::string bytes = read_whole_file(model, most_bytes);
  const cv::Mat answer = run(model, bytes, as_input(picture, size_for(model, bytes, picture)));
  const int dimensions = answer.dims;
  const bool is_map = answer.type() == CV_32F && dimensions >= 2 && answer.size[dimensions - 1] > 1 &&
                      answer.size[dimensions - 2] > 1 &&
                      answer.total() == static_cast<std::size_t>(answer.size[dimensions - 1]) *
                                            static_cast<std::size_t>(answer.size[dimensions - 2]);
  if (!is_map) refuse(model, "does not give one number a pixel");
  Image<float> depth(answer.size[dimensions - 1], answer.size[dimensions - 2]);
  std::copy_n(answer.ptr<float>(), answer.total(), depth.pixels().begin());
  // The picture was squeezed into the network's shape: that is undone, as wide as the answer.
  const double step = static_cast<double>(picture.width()) / depth.width();
  Image<float> shaped(depth.width(), std::max(2, static_cast<int>(std::lround(picture.height() / step))));
  cv::Mat target = as_mat(shaped);
  cv::resize(as_mat(depth), target, target.size(), 0, 0, cv::INTER_LINEAR);
  return shaped;
}

}  // namespace wheatstone
