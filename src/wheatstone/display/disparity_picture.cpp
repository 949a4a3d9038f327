#include "wheatstone/display/disparity_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// In the colours that a map of the same scene has.
Image<Rgb8> coloured_as(ImageView<const float> map, ImageView<const float> disparity) {
  const float far = disparity_percentile(map, 0.005), near = disparity_percentile(map, 0.995);
  const float range = std::max(near - far, 1e-6f);
  Image<std::uint8_t> levels(disparity.width(), disparity.height());
  for (int y = 0; y < levels.height(); ++y)
    for (int x = 0; x < levels.width(); ++x)
      levels(x, y) = static_cast<std::uint8_t>(255 * std::clamp((disparity(x, y) - far) / range, 0.f, 1.f));
  cv::Mat coloured;
  cv::applyColorMap(as_mat(levels), coloured, cv::COLORMAP_TURBO);
  Image<Rgb8> picture(disparity.width(), disparity.height());
  cv::Mat target = as_mat(picture);
  cv::cvtColor(coloured, target, cv::COLOR_BGR2RGB);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      if (!std::isfinite(disparity(x, y))) picture(x, y) = {};
  return picture;
}

}  // namespace

Image<Rgb8> disparity_picture(ImageView<const float> disparity) { return coloured_as(disparity, disparity); }

Image<Rgb8> disparity_over(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                           ImageView<const float> left_disparity) {
  Image<Rgb8> picture = coloured_as(left_disparity, disparity);
  cv::Mat grey, mixed = as_mat(picture);
  cv::cvtColor(as_mat(photograph), grey, cv::COLOR_RGB2GRAY);
  cv::cvtColor(grey, grey, cv::COLOR_GRAY2RGB);
  cv::addWeighted(mixed, 0.5, grey, 0.5, 0, mixed);
  return picture;
}

}  // namespace wheatstone
