#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/calibration/rectifying_map.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// The largest upright rectangle, in pixels, that lies wholly where a mask (CV_8UC1) is not 0. Empty where it is 0
/// everywhere.
cv::Rect largest_rectangle_within(const cv::Mat& mask);

/// A photograph as its rectified picture shows it, from (0, 0) on; beyond the photograph its border goes on.
Image<Rgb8> warped(ImageView<const Rgb8> photograph, const RectifyingMap& map, cv::Size size);
Image<Rgb16> warped(ImageView<const Rgb16> photograph, const RectifyingMap& map, cv::Size size);

/// The largest upright rectangle of a canvas from (0, 0) to `size` that both photographs cover, to a thousandth of the
/// canvas's longer side. Empty where there is none.
cv::Rect covered_window(const RectifyingMap& left, const RectifyingMap& right, cv::Size size);

}  // namespace wheatstone
