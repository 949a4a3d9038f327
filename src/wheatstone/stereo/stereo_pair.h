#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A pair in memory that is lent.
struct StereoPairView {
  ImageView<const Rgb8> left;
  ImageView<const Rgb8> right;
};

/// Two rectified pictures of one scene, same size: a point at (x, y) in `left` is at (x − disparity, y) in `right`.
struct StereoPair {
  Image<Rgb8> left;
  Image<Rgb8> right;
  operator StereoPairView() const { return {left, right}; }
};

/// The geometry of a pair in memory that is lent.
struct StereoGeometryView {
  ImageView<const float> left_disparity;
  ImageView<const float> right_disparity;
  ImageView<const std::uint8_t> left_occlusion;
  ImageView<const std::uint8_t> right_occlusion;
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
  operator StereoGeometryView() const { return {left_disparity, right_disparity, left_occlusion, right_occlusion}; }
};

}  // namespace wheatstone
