#pragma once

// Wheatstone's images as OpenCV matrices and back, without a copy. For .cpp files, never installed.

#include <opencv2/core.hpp>

#include "wheatstone/image/image.h"

namespace wheatstone {

template <class Pixel>
constexpr int opencv_type() {
  using Plain = std::remove_const_t<Pixel>;
  if constexpr (std::is_same_v<Plain, Rgb8>) return CV_8UC3;
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

}  // namespace wheatstone
