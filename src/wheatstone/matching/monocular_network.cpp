#include "wheatstone/matching/monocular_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/network_inputs_internal.h"

namespace wheatstone {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& model, const std::string& why) {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: {}, expected an ONNX network that takes one picture, 1x3xHEIGHTxWIDTH, and gives its "
                          "inverse depth, 1xHEIGHTxWIDTH",
                          model.string(), why));
}

/// A side that the network leaves open keeps the picture's shape, at a size that such networks were trained for.
int side_for(const std::filesystem::path& model, std::int64_t wanted, int picture_px, int shorter_px) {
  constexpr int step = 224, shorter_side = 2 * step, longest_side = 8 * step;
  if (wanted < 0 || wanted > most_network_side_px)
    refuse(model, fmt::format("takes pictures {} pixels wide or high", wanted));
  if (wanted > 0) return static_cast<int>(wanted);
  const double scaled = static_cast<double>(shorter_side) * picture_px / shorter_px;
  return std::min(static_cast<int>(std::lround(scaled / step)) * step, longest_side);
}

NetworkInput input_of(const std::filesystem::path& model, std::string_view bytes) {
  const std::vector<NetworkInput> inputs = network_inputs(bytes);
  if (inputs.empty()) refuse(model, "is not an ONNX network");
  if (inputs.size() != 1) refuse(model, fmt::format("has {} inputs", inputs.size()));
  const auto& sides = inputs.front().sides;
  if (sides.size() != 4 || sides[0] > 1 || (sides[1] != 3 && sides[1] != 0))
    refuse(model, fmt::format("its input '{}' has another shape", inputs.front().name));
  return inputs.front();
}

cv::Size size_for(const std::filesystem::path& model, const NetworkInput& input, ImageView<const Rgb8> picture) {
  const auto& sides = input.sides;
  const int shorter = std::min(picture.width(), picture.height());
  return {side_for(model, sides[3], picture.width(), shorter), side_for(model, sides[2], picture.height(), shorter)};
}

cv::Mat as_input(ImageView<const Rgb8> picture, cv::Size size) {
  cv::Mat sized;
  const bool is_reduced = size.width < picture.width();
  cv::resize(as_mat(picture), sized, size, 0, 0, is_reduced ? cv::INTER_AREA : cv::INTER_CUBIC);
  return network_picture(sized, NetworkValues::imagenet);
}

/// What OpenCV says goes into the message.
template <class Work>
auto with_opencv(const std::filesystem::path& model, Work work) {
  try {
    return work();
  } catch (const cv::Exception& error) {
    refuse(model, fmt::format("OpenCV cannot run it ({})", error.err.substr(0, error.err.find('\n'))));
  }
}

}  // namespace

struct MonocularNetwork::Implementation {
  std::filesystem::path model;
  NetworkInput input;
  cv::dnn::Net network;
};

MonocularNetwork::MonocularNetwork(const std::filesystem::path& model) {
  const std::string bytes = read_whole_file(model, most_network_bytes);
  NetworkInput input = input_of(model, bytes);
  cv::dnn::Net network = with_opencv(model, [&] { return cv::dnn::readNetFromONNX(bytes.data(), bytes.size()); });
  implementation_ = std::make_unique<Implementation>(Implementation{model, std::move(input), network});
}
MonocularNetwork::MonocularNetwork(MonocularNetwork&&) noexcept = default;
MonocularNetwork& MonocularNetwork::operator=(MonocularNetwork&&) noexcept = default;
MonocularNetwork::~MonocularNetwork() = default;

Image<float> depth_by_network(ImageView<const Rgb8> picture, const std::filesystem::path& model) {
  return MonocularNetwork(model).depth_of(picture);
}

Image<float> MonocularNetwork::depth_of(ImageView<const Rgb8> picture) {
  const std::filesystem::path& model = implementation_->model;
  cv::dnn::Net& network = implementation_->network;
  const cv::Mat sized = as_input(picture, size_for(model, implementation_->input, picture));
  const cv::Mat answer = with_opencv(model, [&] {
    network.setInput(sized);
    return network.forward(network.getUnconnectedOutLayersNames().back()).clone();
  });
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
