#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace wheatstone {

/// Two descriptors that are each other's nearest.
struct BinaryMatch {
  int left, right;    ///< rows
  int distance_bits;  ///< that differ
};

/// Which descriptors of 256 bits, one a row of two 8-bit matrices, are each other's nearest; of equally near ones the
/// first is. In the order of the left ones; the same with every instruction set and on any number of threads.
std::vector<BinaryMatch> match_binary_descriptors(const cv::Mat& left, const cv::Mat& right);

/// The nearest of some descriptors to one.
struct NearestBinary {
  int row, distance_bits;
};

/// Descriptors word by word, so that vectors of them can be compared; the last one stands again and again after the
/// end.
struct BinaryDescriptors {
  static constexpr int words = 4, widest_vector = 8;
  int count = 0;
  std::array<std::vector<std::uint64_t>, words> word;
};

}  // namespace wheatstone
