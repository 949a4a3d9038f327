#pragma once

#include <cstdint>
#include <optional>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

struct SyntheticStillOptions {
  int width = 960;  ///< of each view, in pixels; the picture's height decides how large things are
  int height = 720;
  std::uint64_t seed = 1;                     ///< moves, swaps and recolours what lies on the table
  int samples_a_side = 2;                     ///< each pixel is the mean, in linear light, of this many squared samples
  std::optional<float> largest_disparity_px;  ///< of the nearest point; none: 45 pixels in a picture 640 wide
  std::optional<float> least_disparity_px;    ///< of the wall; none: 6 pixels in a picture 640 wide
  bool converged = false;  ///< moves both views so that the middle of that range gets disparity 0, either side a sign
};

/// A pair with its exact geometry: disparities belong to the rays through the pixels' centres, and a pixel is occluded
/// where its point is hidden from the other camera or falls outside the other picture.
struct SyntheticStill {
  StereoPair pictures;
  StereoGeometry geometry;
};

/// One view and its exact disparity, in this view's own geometry.
struct SyntheticView {
  Image<Rgb8> picture;
  Image<float> disparity;
};

/// A still life of fruit, flowers and pottery on a table by a window, ray-cast by two parallel cameras whose pictures
/// are shifted. All light is that which the cyclopean eye sees: a point has one colour in every view. The same options
/// give the same bytes on any number of threads. Throws Error{wrong_usage} for sizes or ranges that make no sense.
SyntheticStill make_synthetic_still(const SyntheticStillOptions& options = {}, const Progress& progress = {});

/// The same still life from any view position.
SyntheticView make_synthetic_view(const SyntheticStillOptions& options, ViewPosition view,
                                  const Progress& progress = {});

}  // namespace wheatstone
