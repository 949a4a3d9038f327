#pragma once

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace wheatstone {

/// A copy scaled by `scale` in 0..1 along both sides, each of which keeps at least one pixel: of a narrow strip, a side
/// would round to none.
inline cv::Mat shrunk(const cv::Mat& picture, double scale, int interpolation = cv::INTER_AREA) {
  const auto side = [scale](int px) { return cv::saturate_cast<int>(px * scale); };
  cv::Mat small;
  if (side(picture.cols) > 0 && side(picture.rows) > 0) {
    cv::resize(picture, small, {}, scale, scale, interpolation);
  } else {
    cv::resize(picture, small, {std::max(side(picture.cols), 1), std::max(side(picture.rows), 1)}, 0, 0, interpolation);
  }
  return small;
}

}  // namespace wheatstone
