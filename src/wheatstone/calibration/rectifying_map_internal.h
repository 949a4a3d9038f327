#pragma once

#include <opencv2/core.hpp>

#include "wheatstone/calibration/rectifying_map.h"

namespace wheatstone {

/// What a row correction's coefficients are multiplied with at a straightened place.
std::array<double, 10> row_terms(const RectifyingMap& map, PicturePoint straightened);

/// A place without radial distortion.
PicturePoint straightened_place(const RectifyingMap& map, PicturePoint in_photograph);

PicturePoint carried(const cv::Matx33d& homography, PicturePoint point);

/// photograph_place with the homography's inverse at hand, for many places.
PicturePoint photograph_place(const RectifyingMap& map, const cv::Matx33d& homography_back, PicturePoint in_rectified);

/// The same map, followed by an affine one. Columns that depend on the row follow the row before its correction.
void follow_with(RectifyingMap& map, const cv::Matx33d& after);

}  // namespace wheatstone
