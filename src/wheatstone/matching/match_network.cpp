#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/pair_network_opencv.h"

namespace wheatstone {
namespace {

/// The one-channel map among the sides 1 of a network's answer.
cv::Mat as_map(const PairNetwork& network, const cv::Mat& answer) {
  std::vector<int> sides;
  for (int i = 0; i < answer.dims; ++i)
    if (answer.size[i] != 1) sides.push_back(answer.size[i]);
  if (sides.size() != 2 || answer.type() != CV_32F) network.refuse("does not return one number per pixel");
  return answer.reshape(1, sides[0]);
}

}  // namespace

Image<float> match_with_network(const cv::Mat& own, const cv::Mat& other, const MatchOptions& options) {
  PairNetwork network(options.model, "a disparity");
  cv::Mat map = as_map(network, network.answer(own, other, options.model_values));
  // Some give the flow from left to right, whose sign is the opposite.
  if (cv::countNonZero(map < 0) > static_cast<int>(map.total() / 2)) map = -map;

  Image<float> disparity(own.cols, own.rows);
  cv::Mat target = as_mat(disparity);
  cv::resize(map, target, target.size(), 0, 0, cv::INTER_NEAREST);
  // Disparities are pixels of the width that went in, whatever the answer's own size.
  target *= static_cast<double>(own.cols) / network.size_for(own.size()).width;
  for (float& d : disparity.pixels())
    if (!(std::abs(d) < static_cast<float>(own.cols))) d = std::numeric_limits<float>::quiet_NaN();
  return disparity;
}

}  // namespace wheatstone
