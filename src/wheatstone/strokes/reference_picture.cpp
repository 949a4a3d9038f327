#include "wheatstone/strokes/reference_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// OpenCV's median is quick up to this width; and a brush shows no detail finer than a fraction of its radius.
constexpr int direct_kernel_px = 5;

/// The odd number next to a width.
int odd_px(float width) { return 2 * static_cast<int>(std::lround((width - 1) / 2)) + 1; }

cv::Mat blurred(const cv::Mat& photograph, int kernel_px, ReferenceFilter filter) {
  cv::Mat result;
  if (kernel_px <= 1) return photograph;
  if (filter == ReferenceFilter::gaussian) {
    cv::GaussianBlur(photograph, result, {kernel_px, kernel_px}, 0);
    return result;
  }
  if (kernel_px <= direct_kernel_px) {
    cv::medianBlur(photograph, result, kernel_px);
    return result;
  }
  int reduction = 2;
  while (odd_px(static_cast<float>(kernel_px) / static_cast<float>(reduction)) > direct_kernel_px) ++reduction;
  const cv::Size reduced_size(std::max(photograph.cols / reduction, 1), std::max(photograph.rows / reduction, 1));
  cv::Mat reduced;
  cv::resize(photograph, reduced, reduced_size, 0, 0, cv::INTER_AREA);
  cv::medianBlur(reduced, reduced, odd_px(static_cast<float>(kernel_px) / static_cast<float>(reduction)));
  cv::resize(reduced, result, photograph.size(), 0, 0, cv::INTER_LINEAR);
  return result;
}

}  // namespace

int blur_kernel_px(float blur, float radius_px) { return 2 * static_cast<int>(std::lround(blur * radius_px)) + 1; }

ReferencePicture make_reference(ImageView<const Rgb8> photograph, float radius_px, const Style& style) {
  const int width = photograph.width(), height = photograph.height();
  const cv::Mat picture = blurred(as_mat(photograph), blur_kernel_px(style.blur, radius_px), style.reference_filter);
  ReferencePicture reference;
  for (Image<std::uint8_t>* plane : {&reference.red, &reference.green, &reference.blue, &reference.luminance})
    *plane = Image<std::uint8_t>(width, height);
  cv::Mat planes[] = {as_mat(reference.red), as_mat(reference.green), as_mat(reference.blue)};
  cv::split(picture, planes);
  cv::Mat luminance = as_mat(reference.luminance);
  cv::cvtColor(picture, luminance, cv::COLOR_RGB2GRAY);
  if (style.orientation == Orientation::smooth || style.marks == Marks::fitted_strokes) {
    constexpr float finest_detail_px = 3;
    reference.orientation = OrientationField(reference.luminance, std::max(radius_px / 2, finest_detail_px));
    if (style.marks == Marks::fitted_strokes) {
      reference.orientation.round();
      reference.luminance = {};  // only traced strokes turn by it
    }
  }
  return reference;
}

}  // namespace wheatstone
