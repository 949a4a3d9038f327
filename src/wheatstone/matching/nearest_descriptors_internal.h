#pragma once

#include <array>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

namespace wheatstone {

/// The descriptors of a set that are nearest to one, the nearest first; of equally near ones the first of the set.
struct NearestDescriptors {
  static constexpr int count = 3;
  static constexpr float nowhere = std::numeric_limits<float>::infinity();
  std::array<int, count> row{-1, -1, -1};  ///< −1 where the set has fewer
  std::array<float, count> squared_distance{nowhere, nowhere, nowhere};
};

/// For each row of `from`, the nearest rows of `into`. Both hold whole numbers as 32-bit floating-point ones, a
/// descriptor a row. Where no squared length is above 2²², as with SIFT's, every sum is exact: the same result with
/// every instruction set and any number of threads.
std::vector<NearestDescriptors> nearest_descriptors(const cv::Mat& from, const cv::Mat& into);

/// A set of descriptors as vectors of them are compared: each value of several descriptors beside each other.
struct DescriptorBlocks {
  static constexpr int side_by_side = 16;
  int columns = 0;
  std::vector<float> values;           ///< block by block, in each value by value
  std::vector<float> squared_lengths;  ///< infinite where the last block is not full
};

}  // namespace wheatstone
