#include "wheatstone/matching/pair_network_opencv.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/matching/network_inputs_internal.h"

namespace wheatstone {
namespace {

cv::Mat as_input(const cv::Mat& picture, cv::Size size, NetworkValues values) {
  cv::Mat sized;
  cv::resize(picture, sized, size, 0, 0, cv::INTER_LINEAR);
  return network_picture(sized, values);
}

/// Two inputs as one of twice the channels.
cv::Mat stacked(const cv::Mat& first, const cv::Mat& second) {
  const int sides[] = {1, 6, first.size[2], first.size[3]};
  cv::Mat both(4, sides, CV_32F);
  std::copy_n(first.ptr<float>(), first.total(), both.ptr<float>());
  std::copy_n(second.ptr<float>(), second.total(), both.ptr<float>() + first.total());
  return both;
}

/// OpenCV's message without the place in its own source.
std::string reason(std::string_view message) {
  constexpr std::string_view before = "error: ", after = " in function";
  if (const auto begin = message.rfind(before); begin != message.npos) message.remove_prefix(begin + before.size());
  message = message.substr(0, message.find(after));
  return std::string(message.substr(0, message.find('\n')));
}

/// What OpenCV says goes into the message.
template <class Work>
auto with_opencv(const PairNetwork& network, Work work) {
  try {
    return work();
  } catch (const cv::Exception& error) {
    network.refuse(fmt::format("OpenCV cannot run it ({})", reason(error.err)));
  }
}

}  // namespace

PairNetwork::PairNetwork(std::filesystem::path model, std::string gives)
    : model_(std::move(model)), gives_(std::move(gives)) {
  const std::string bytes = read_whole_file(model_, most_network_bytes);
  inputs_ = network_inputs(bytes);
  if (inputs_.empty()) refuse("is not an ONNX network");
  if (inputs_.size() > 2) refuse(fmt::format("has {} inputs", inputs_.size()));
  const std::int64_t channels = inputs_.size() == 2 ? 3 : 6;
  for (const NetworkInput& input : inputs_)
    if (input.sides.size() != 4 || input.sides[0] > 1 || (input.sides[1] != channels && input.sides[1] != 0))
      refuse(fmt::format("input '{}' is not 1x{}xHEIGHTxWIDTH", input.name, channels));
  network_ = with_opencv(*this, [&] { return cv::dnn::readNetFromONNX(bytes.data(), bytes.size()); });
}

void PairNetwork::refuse(const std::string& why) const {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}, expected an ONNX network that takes two pictures and gives {}",
                                                model_.string(), why, gives_));
}

int PairNetwork::side_for(std::int64_t wanted, int picture_px) const {
  constexpr int step = 32;
  if (wanted == 0) return (picture_px + step - 1) / step * step;
  if (wanted < 0 || wanted > most_network_side_px) refuse(fmt::format("takes pictures {} pixels wide or high", wanted));
  return static_cast<int>(wanted);
}

cv::Size PairNetwork::size_for(cv::Size picture) const {
  const auto size_of = [&](const NetworkInput& input) {
    return cv::Size(side_for(input.sides[3], picture.width), side_for(input.sides[2], picture.height));
  };
  const cv::Size size = size_of(inputs_.front());
  if (size_of(inputs_.back()) != size) refuse("its two inputs differ in size");
  return size;
}

cv::Mat PairNetwork::answer(const cv::Mat& first, const cv::Mat& second, NetworkValues values) {
  const cv::Size size = size_for(first.size());
  const cv::Mat a = as_input(first, size, values), b = as_input(second, size, values);
  return with_opencv(*this, [&] {
    if (inputs_.size() == 2) {
      network_.setInput(a, inputs_[0].name);
      network_.setInput(b, inputs_[1].name);
    } else {
      network_.setInput(stacked(a, b), inputs_[0].name);
    }
    return network_.forward(network_.getUnconnectedOutLayersNames().back()).clone();
  });
}

}  // namespace wheatstone
