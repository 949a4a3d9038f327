#include "wheatstone/image/grain.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

template <class Pixel>
Image<Pixel> median_5x5(ImageView<const Pixel> picture) {
  Image<Pixel> result(picture.width(), picture.height());
  cv::Mat to = as_mat(result);
  constexpr int kernel = 5;
  cv::medianBlur(as_mat(picture), to, kernel);
  return result;
}

}  // namespace

Image<Rgb8> without_grain(ImageView<const Rgb8> photograph, float scale) {
  Image<Rgb8> smooth(photograph.width(), photograph.height()), result(photograph.width(), photograph.height());
  constexpr double colour_reach = 35;
  const double reach_px = 3 * std::max(static_cast<double>(scale), 0.5);
  const int kernel = 2 * static_cast<int>(std::lround(1.5 * reach_px)) + 1;
  cv::Mat first = as_mat(smooth), second = as_mat(result);
  cv::bilateralFilter(as_mat(photograph), first, kernel, colour_reach, reach_px);
  cv::bilateralFilter(first, second, kernel, colour_reach, reach_px);
  return result;
}

Image<Rgb8> without_grain_quickly(ImageView<const Rgb8> photograph) { return median_5x5(photograph); }

Image<float> without_outliers(ImageView<const float> disparity) { return median_5x5(disparity); }

}  // namespace wheatstone
