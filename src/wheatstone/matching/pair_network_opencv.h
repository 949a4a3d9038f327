#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "wheatstone/matching/match.h"
#include "wheatstone/matching/network_inputs_internal.h"

namespace wheatstone {

/// A network in an ONNX file that takes two pictures: 1x3xHEIGHTxWIDTH each, or 1x6xHEIGHTxWIDTH together, the first
/// picture's channels before the second's.
class PairNetwork {
 public:
  /// `gives` says in messages what is expected of the network, as "a disparity". Throws Error{bad_input} where the file
  /// is missing or no such network.
  PairNetwork(std::filesystem::path model, std::string gives);

  /// The size in which pictures of `picture` pixels go in: a side that the network leaves open is the picture's,
  /// rounded up to a multiple of 32. Throws as the constructor.
  cv::Size size_for(cv::Size picture) const;

  /// What it answers to two pictures of one size (CV_8UC3, red first), CV_32F. Networks that refine step by step answer
  /// with the finest map last: that one is taken. Throws as the constructor.
  cv::Mat answer(const cv::Mat& first, const cv::Mat& second, NetworkValues values);

  /// Throws Error{bad_input} that names the file.
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  int side_for(std::int64_t wanted, int picture_px) const;

  std::filesystem::path model_;
  std::string gives_;
  std::vector<NetworkInput> inputs_;
  cv::dnn::Net network_;
};

}  // namespace wheatstone
