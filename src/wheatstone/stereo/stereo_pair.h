#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Two rectified pictures of one scene, same size: a point at (x, y) in `left` is at (x − disparity, y) in `right`.
struct StereoPair {
  Image<Rgb8> left;
  Image<Rgb8> right;
};

/// Where every pixel of a pair lies, in both views' own geometries. All four images have the size of the pictures.
///
/// Disparity is x_left − x_right in pixels, larger is nearer, negative behind the cameras' convergence; NaN is unknown.
/// The masks are 255 where a pixel has no counterpart in the other view and 0 elsewhere.
struct StereoGeometry {
  Image<float> left_disparity;
  Image<float> right_disparity;
  Image<std::uint8_t> left_occlusion;
  Image<std::uint8_t> right_occlusion;
};

}  // namespace wheatstone
