#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/pair_network_opencv.h"
#include "wheatstone/motion/flow_network_internal.h"

namespace wheatstone {
namespace {

/// The answer's two maps, the flow across and down, in pixels of what went in.
std::array<cv::Mat, 2> as_maps(const PairNetwork& network, const cv::Mat& answer) {
  const bool is_flow = answer.type() == CV_32F && answer.dims == 4 && answer.size[0] == 1 && answer.size[1] == 2;
  if (!is_flow) network.refuse("does not return 1x2xHEIGHTxWIDTH");
  const auto map = [&](int channel) {
    return cv::Mat(answer.size[2], answer.size[3], CV_32F, const_cast<float*>(answer.ptr<float>(0, channel)));
  };
  return {map(0), map(1)};
}

/// A map of the answer at the frame's size, in its pixels. What is no number, or leads out of every picture, is 0: the
/// other direction does not confirm it.
Image<float> at_size(const cv::Mat& map, cv::Size frame, double scale) {
  Image<float> result(frame.width, frame.height);
  cv::Mat target = as_mat(result);
  cv::resize(map, target, frame, 0, 0, cv::INTER_LINEAR);
  const auto most = static_cast<float>(frame.width + frame.height);
  for (float& value : result.pixels()) {
    value *= static_cast<float>(scale);
    if (!(std::abs(value) < most)) value = 0;
  }
  return result;
}

cv::Mat reduced_for_network(ImageView<const Rgb8> picture, double size) {
  cv::Mat whole = as_mat(picture);
  if (size >= 1) return whole;
  return shrunk(whole, size);
}

}  // namespace

FlowPair flow_by_network(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const FlowOptions& options) {
  PairNetwork network(options.model, "an optical flow");
  const cv::Mat a = reduced_for_network(first, options.size), b = reduced_for_network(second, options.size);
  const cv::Size frame(first.width(), first.height()), inside = network.size_for(a.size());
  const auto one_way = [&](const cv::Mat& from, const cv::Mat& to) {
    const cv::Mat answer = network.answer(from, to, options.model_values);
    const auto [across, down] = as_maps(network, answer);
    return Flow{at_size(across, frame, static_cast<double>(frame.width) / inside.width),
                at_size(down, frame, static_cast<double>(frame.height) / inside.height)};
  };
  return {one_way(a, b), one_way(b, a)};
}

}  // namespace wheatstone
