#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/network_inputs_internal.h"
#include "wheatstone/matching/network_picture_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t most_bytes = std::size_t{2} << 30;
constexpr std::int64_t most_side_px = 1 << 14;

[[noreturn]] void refuse(const std::string& model, const std::string& why) {
  throw Error(
      ErrorKind::bad_input,
      fmt::format("{}: {}, expected an ONNX network that takes two pictures and gives a disparity", model, why));
}

/// How a network wants its pictures.
struct Layout {
  std::vector<std::string> names;  ///< one for a picture each, or one for both, stacked
  cv::Size size;
};

/// A side that the network leaves open takes the picture's, rounded up to what networks halve again and again.
int side_for(const std::string& model, std::int64_t wanted, int picture_px) {
  constexpr int step = 32;
  if (wanted == 0) return (picture_px + step - 1) / step * step;
  if (wanted < 0 || wanted > most_side_px) refuse(model, fmt::format("takes pictures {} pixels wide or high", wanted));
  return static_cast<int>(wanted);
}

Layout layout_of(const std::string& model, std::string_view bytes, cv::Size picture) {
  const std::vector<NetworkInput> inputs = network_inputs(bytes);
  if (inputs.empty()) refuse(model, "is not an ONNX network");
  if (inputs.size() > 2) refuse(model, fmt::format("has {} inputs", inputs.size()));
  Layout layout;
  const std::int64_t channels = inputs.size() == 2 ? 3 : 6;
  for (const NetworkInput& input : inputs) {
    const auto& sides = input.sides;
    if (sides.size() != 4 || sides[0] > 1 || (sides[1] != channels && sides[1] != 0))
      refuse(model, fmt::format("input '{}' is not 1x{}xHEIGHTxWIDTH", input.name, channels));
    const cv::Size size(side_for(model, sides[3], picture.width), side_for(model, sides[2], picture.height));
    if (!layout.names.empty() && size != layout.size) refuse(model, "its two inputs differ in size");
    layout.size = size;
    layout.names.push_back(input.name);
  }
  return layout;
}

cv::Mat as_input(const cv::Mat& picture, cv::Size size, NetworkValues values) {
  cv::Mat sized;
  cv::resize(picture, sized, size, 0, 0, cv::INTER_LINEAR);
  return network_picture(sized, values);
}

/// The one-channel map among the sides 1 of a network's answer.
cv::Mat as_map(const std::string& model, const cv::Mat& answer) {
  std::vector<int> sides;
  for (int i = 0; i < answer.dims; ++i)
    if (answer.size[i] != 1) sides.push_back(answer.size[i]);
  if (sides.size() != 2 || answer.type() != CV_32F) refuse(model, "does not return one number per pixel");
  return answer.reshape(1, sides[0]);
}

/// OpenCV's message without the place in its own source.
std::string reason(std::string_view message) {
  constexpr std::string_view before = "error: ", after = " in function";
  if (const auto begin = message.rfind(before); begin != message.npos) message.remove_prefix(begin + before.size());
  message = message.substr(0, message.find(after));
  return std::string(message.substr(0, message.find('\n')));
}

cv::Mat run(const MatchOptions& options, const std::string& bytes, const Layout& layout, const cv::Mat& own,
            const cv::Mat& other) {
  const cv::Mat first = as_input(own, layout.size, options.model_values);
  const cv::Mat second = as_input(other, layout.size, options.model_values);
  try {
    cv::dnn::Net network = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    if (layout.names.size() == 2) {
      network.setInput(first, layout.names[0]);
      network.setInput(second, layout.names[1]);
    } else {
      // Channels follow each other: the second picture's behind the first's.
      const int sides[] = {1, 6, layout.size.height, layout.size.width};
      cv::Mat both(4, sides, CV_32F);
      std::copy_n(first.ptr<float>(), first.total(), both.ptr<float>());
      std::copy_n(second.ptr<float>(), second.total(), both.ptr<float>() + first.total());
      network.setInput(both, layout.names[0]);
    }
    // Networks that refine step by step answer with the finest map last.
    return as_map(options.model, network.forward(network.getUnconnectedOutLayersNames().back())).clone();
  } catch (const cv::Exception& error) {
    refuse(options.model, fmt::format("OpenCV cannot run it ({})", reason(error.err)));
  }
}

}  // namespace

Image<float> match_with_network(const cv::Mat& own, const cv::Mat& other, const MatchOptions& options) {
  const std::string bytes = read_whole_file(options.model, most_bytes);
  const Layout layout = layout_of(options.model, bytes, own.size());
  cv::Mat map = run(options, bytes, layout, own, other);
  // Some give the flow from left to right, whose sign is the opposite.
  if (cv::countNonZero(map < 0) > static_cast<int>(map.total() / 2)) map = -map;

  Image<float> disparity(own.cols, own.rows);
  cv::Mat target = as_mat(disparity);
  cv::resize(map, target, target.size(), 0, 0, cv::INTER_NEAREST);
  // Disparities are pixels of the width that went in, whatever the answer's own size.
  target *= static_cast<double>(own.cols) / layout.size.width;
  for (float& d : disparity.pixels())
    if (!(std::abs(d) < static_cast<float>(own.cols))) d = std::numeric_limits<float>::quiet_NaN();
  return disparity;
}

}  // namespace wheatstone
