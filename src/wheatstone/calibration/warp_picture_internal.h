#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/calibration/rectifying_map.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// A photograph as its rectified picture shows it, from (0, 0) on; beyond the photograph its border goes on.
Image<Rgb8> warped(ImageView<const Rgb8> photograph, const RectifyingMap& map, cv::Size size);

/// The largest upright rectangle of a canvas from (0, 0) to `size` that both photographs cover, to a thousandth of the
/// canvas's longer side. Empty where there is none.
cv::Rect covered_window(const RectifyingMap& left, const RectifyingMap& right, cv::Size size);

}  // namespace wheatstone
