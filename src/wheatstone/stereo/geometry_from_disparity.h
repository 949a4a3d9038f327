#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

struct GeometryOptions {
  float occlusion_tolerance_px = 1;  ///< a pixel is occluded where the other view is nearer by more than this
  int least_occlusion_px = 12;       ///< smaller connected specks of the masks are dropped; 1 keeps all
};

/// Completes what is known of a pair's geometry: fills unknown disparities from the farther side, warps the disparity
/// into the other view (nearest wins), and finds the occlusion masks of both (Stavrakis & Gelautz 2004, sec. 3.1).
/// Afterwards every disparity is finite. Throws Error{bad_input} where no disparity is known.
StereoGeometry geometry_from_left(Image<float> left_disparity, const GeometryOptions& options = {});

/// The same from disparities of both views, each in its own geometry. Throws Error{bad_input} where sizes differ.
StereoGeometry geometry_from_both(Image<float> left_disparity, Image<float> right_disparity,
                                  const GeometryOptions& options = {});

/// Gives every unknown pixel (not finite) the smaller, farther one of the two nearest known disparities on its scan
/// line; rows without any take the nearest row that has some. Throws Error{bad_input} where nothing is known.
void fill_from_farther_side(Image<float>& disparity);

}  // namespace wheatstone
