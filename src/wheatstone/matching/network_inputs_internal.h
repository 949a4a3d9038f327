#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// What an ONNX network takes: a name, and sides of which 0 is left open.
struct NetworkInput {
  std::string name;
  std::vector<std::int64_t> sides;
};

/// Larger files and sides are refused.
inline constexpr std::size_t most_network_bytes = std::size_t{2} << 30;
inline constexpr std::int64_t most_network_side_px = 1 << 14;

/// The inputs of an ONNX file's graph that are not weights, in their order. Empty where the bytes are no ONNX file with
/// a graph: damaged, cut off, or something else.
std::vector<NetworkInput> network_inputs(std::string_view bytes);

/// A picture (CV_8UC3, red first) of the size that a network takes, as its input 1x3xHxW.
cv::Mat network_picture(const cv::Mat& picture, NetworkValues values);

}  // namespace wheatstone
