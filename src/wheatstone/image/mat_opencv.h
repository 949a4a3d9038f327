#pragma once

// Wheatstone's images as OpenCV matrices and back, without a copy. For .cpp files, never installed.

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/colour.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

template <class Pixel>
constexpr int opencv_type() {
  using Plain = std::remove_const_t<Pixel>;
  if constexpr (std::is_same_v<Plain, Rgb8>) return CV_8UC3;
  if constexpr (std::is_same_v<Plain, Rgb16>) return CV_16UC3;
  if constexpr (std::is_same_v<Plain, std::uint8_t>) return CV_8UC1;
  if constexpr (std::is_same_v<Plain, std::uint16_t>) return CV_16UC1;
  if constexpr (std::is_same_v<Plain, std::int16_t>) return CV_16SC1;
  if constexpr (std::is_same_v<Plain, float>) return CV_32FC1;
}

/// The same pixels as a matrix. OpenCV has no const matrix: do not write through one made from a const view.
template <class Pixel>
cv::Mat as_mat(ImageView<Pixel> view) {
  using Plain = std::remove_const_t<Pixel>;
  return cv::Mat(view.height(), view.width(), opencv_type<Pixel>(), const_cast<Plain*>(view.data()),
                 static_cast<std::size_t>(view.stride()) * sizeof(Plain));
}
template <class Pixel>
cv::Mat as_mat(Image<Pixel>& image) {
  return as_mat(image.view());
}
template <class Pixel>
cv::Mat as_mat(const Image<Pixel>& image) {
  return as_mat(image.view());
}

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

/// The L*, a* and b* of a picture, 8-bit RGB, as three channels of 32-bit float.
inline cv::Mat cielab_of(const cv::Mat& rgb) {
  cv::Mat values(rgb.size(), CV_32FC3);
  for (int y = 0; y < rgb.rows; ++y) {
    for (int x = 0; x < rgb.cols; ++x) {
      const auto& colour = rgb.at<cv::Vec3b>(y, x);
      const Cielab value = cielab_of(Rgb8{colour[0], colour[1], colour[2]});
      values.at<cv::Vec3f>(y, x) = {value.lightness, value.a, value.b};
    }
  }
  return values;
}

}  // namespace wheatstone
