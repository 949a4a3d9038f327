#include "wheatstone/image/cielab_internal.h"

#include <cmath>

#include "wheatstone/image/cielab_opencv.h"
#include "wheatstone/image/srgb.h"

namespace wheatstone {

Cielab cielab_of(Rgb8 colour) {
  const float red = linear_from_srgb(colour.r), green = linear_from_srgb(colour.g), blue = linear_from_srgb(colour.b);
  // Each is a share of the white's.
  const float x = (0.412453f * red + 0.357580f * green + 0.180423f * blue) / 0.950456f;
  const float y = 0.212671f * red + 0.715160f * green + 0.072169f * blue;
  const float z = (0.019334f * red + 0.119193f * green + 0.950227f * blue) / 1.088754f;
  constexpr float dark = 216.f / 24389, slope = 24389.f / (27 * 116);
  const auto curve = [](float share) { return share > dark ? std::cbrt(share) : slope * share + 16.f / 116; };
  const float from_y = curve(y);
  return {116 * from_y - 16, 500 * (curve(x) - from_y), 200 * (from_y - curve(z))};
}

cv::Mat cielab_of(const cv::Mat& rgb) {
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
