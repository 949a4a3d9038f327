#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/motion/flow_network_internal.h"

namespace wheatstone {
namespace {

/// The pyramids of both methods need this much.
constexpr int least_side_px = 16;
constexpr int most_side_px = 32766;  // OpenCV counts the pixels of a side in 16 bits

cv::Mat luminance(ImageView<const Rgb8> picture) {
  cv::Mat grey;
  cv::cvtColor(as_mat(picture), grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat interleaved(const Flow& flow) {
  cv::Mat both;
  cv::merge(std::array{as_mat(flow.x), as_mat(flow.y)}, both);
  cv::patchNaNs(both, 0);
  return both;
}

Flow separated(const cv::Mat& both) {
  Flow flow{Image<float>(both.cols, both.rows), Image<float>(both.cols, both.rows)};
  std::array<cv::Mat, 2> channels{as_mat(flow.x), as_mat(flow.y)};
  cv::split(both, channels.data());
  return flow;
}

/// A frame brought back along a flow into the frame that the flow belongs to.
cv::Mat brought_back(const cv::Mat& frame, const cv::Mat& flow) {
  cv::Mat places(flow.size(), CV_32FC2), result;
  for (int y = 0; y < flow.rows; ++y)
    for (int x = 0; x < flow.cols; ++x)
      places.at<cv::Vec2f>(y, x) = flow.at<cv::Vec2f>(y, x) + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
  cv::remap(frame, result, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

/// OpenCV's own way of starting from a flow changes nothing here: what is left of the motion is estimated instead.
void farneback(const cv::Mat& from, const cv::Mat& to, cv::Mat& flow) {
  constexpr double finer = 0.5, polynomial_deviation = 1.5;
  constexpr int levels = 5, window_px = 25, iterations = 4, polynomial_px = 7;
  const cv::Mat target = flow.empty() ? to : brought_back(to, flow);
  cv::Mat step;
  cv::calcOpticalFlowFarneback(from, target, step, finer, levels, window_px, iterations, polynomial_px,
                               polynomial_deviation, 0);
  flow = flow.empty() ? step : cv::Mat(flow + step);
  // Polynomials blur motion edges: the variational step that inverse search ends with sharpens them.
  cv::VariationalRefinement::create()->calc(from, to, flow);
}

void inverse_search(const cv::Mat& from, const cv::Mat& to, cv::Mat& flow) {
  const auto search = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  // OpenCV hands flow on between neighbours within a thread's rows only: the result would depend on their number.
  search->setUseSpatialPropagation(false);
  search->calc(from, to, flow);
}

/// A flow for pictures of another size.
cv::Mat resized(const cv::Mat& flow, cv::Size size) {
  cv::Mat result;
  cv::resize(flow, result, size, 0, 0, cv::INTER_LINEAR);
  const double across = static_cast<double>(size.width) / flow.cols,
               down = static_cast<double>(size.height) / flow.rows;
  return result.mul(cv::Scalar(across, down));
}

Flow estimate(const cv::Mat& from, const cv::Mat& to, cv::Size full_size, FlowMethod method, const Flow* start) {
  cv::Mat flow;
  if (start != nullptr) flow = interleaved(*start);
  if (start != nullptr && from.size() != full_size) flow = resized(flow, from.size());
  if (method == FlowMethod::farneback) {
    farneback(from, to, flow);
  } else {
    inverse_search(from, to, flow);
  }
  return separated(from.size() == full_size ? flow : resized(flow, full_size));
}

/// The frame's luminance, reduced to a share of its width.
cv::Mat luminance_at(ImageView<const Rgb8> picture, double size) {
  cv::Mat grey = luminance(picture);
  if (size < 1) {
    const auto side = [size](int px) { return std::max(static_cast<int>(std::lround(px * size)), least_side_px); };
    cv::resize(grey, grey, {side(picture.width()), side(picture.height())}, 0, 0, cv::INTER_AREA);
  }
  return grey;
}

template <class Picture>
void expect_size(const Picture& picture, ImageView<const Rgb8> first, const char* what) {
  if (!same_size(picture, first))
    throw Error(ErrorKind::bad_input, fmt::format("{} of {}x{} pixels, expected {}x{} as the first frame", what,
                                                  picture.width(), picture.height(), first.width(), first.height()));
}

}  // namespace

FlowPair estimate_flow(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const FlowOptions& options) {
  if (first.width() < least_side_px || first.height() < least_side_px)
    throw Error(ErrorKind::bad_input,
                fmt::format("the frame is {}x{} pixels, expected at least {} on each side for optical flow",
                            first.width(), first.height(), least_side_px));
  if (std::max(first.width(), first.height()) > most_side_px)
    throw Error(ErrorKind::bad_input,
                fmt::format("the frame is {}x{} pixels, expected at most {} on each side for optical flow",
                            first.width(), first.height(), most_side_px));
  expect_size(second, first, "second frame");
  if (options.start != nullptr)
    for (const Flow* flow : {&options.start->forward, &options.start->backward})
      for (const Image<float>* image : {&flow->x, &flow->y}) expect_size(*image, first, "flow to start from");
  if (!(options.size > 0 && options.size <= 1))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("the optical flow scale is {}, expected above 0 and at most 1", options.size));
  if (options.method == FlowMethod::onnx) return flow_by_network(first, second, options);
  const cv::Mat a = luminance_at(first, options.size), b = luminance_at(second, options.size);
  const cv::Size full_size(first.width(), first.height());
  const FlowPair* start = options.start;
  FlowPair flow;
  tbb::parallel_invoke(
      [&] { flow.forward = estimate(a, b, full_size, options.method, start == nullptr ? nullptr : &start->forward); },
      [&] {
        flow.backward = estimate(b, a, full_size, options.method, start == nullptr ? nullptr : &start->backward);
      });
  return flow;
}

}  // namespace wheatstone
