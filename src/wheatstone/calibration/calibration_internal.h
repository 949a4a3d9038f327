#pragma once

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>

#include "wheatstone/calibration/calibration.h"

namespace wheatstone {

/// A copy of numbers that go row by row.
template <std::size_t count>
cv::Mat as_matrix(const std::array<double, count>& numbers, int rows) {
  return cv::Mat(numbers, true).reshape(1, rows);
}

template <std::size_t count>
void copy_numbers(const cv::Mat& matrix, std::array<double, count>& numbers) {
  cv::Mat plain;
  matrix.convertTo(plain, CV_64F);
  CV_Assert(plain.total() == count && plain.isContinuous());
  std::copy_n(plain.ptr<double>(), count, numbers.begin());
}

/// Fills R1, R2, P1, P2 and Q from the cameras, R and T, so that what is infinitely far has disparity 0.
void add_rectification(StereoCalibration& calibration);

/// Fills E and F from the cameras, R and T.
void add_epipolar_matrices(StereoCalibration& calibration);

}  // namespace wheatstone
