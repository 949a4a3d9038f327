#pragma once

#include <optional>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How disparity follows from depth in a picture of two parallel cameras with equal lenses:
/// scale / depth + offset_px. The scale is the cameras' distance times the focal length in pixels; the offset puts
/// something else than infinity on the screen.
struct DepthFit {
  double scale = 0, offset_px = 0;
};

/// Finds the fit of a pair whose left depth is known, to about a twentieth of a pixel: by matching small copies, and
/// then by comparing colours. Depth is in any unit, positive; infinitely far is allowed. None where nothing matches, or
/// all is equally far.
std::optional<DepthFit> fit_depth(const StereoPair& eyes, ImageView<const float> left_depth);

/// Disparities in pixels; unknown (NaN) where depth is not positive.
Image<float> disparity_of_depth(ImageView<const float> depth, const DepthFit& fit);

/// The share of the left view's pixels, 0..1, that have the same disparity, to a pixel, in the right view.
double agreeing_share(ImageView<const float> left_disparity, ImageView<const float> right_disparity);

}  // namespace wheatstone
