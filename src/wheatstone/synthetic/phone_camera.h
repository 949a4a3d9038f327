#pragma once

#include "wheatstone/motion/flow.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {

/// What two hand-held cameras do to a pair.
struct PhoneCameraOptions {
  double most_turn_degrees = 2;      ///< each camera is turned by up to this about each of its axes; the seed says how
  double radial_distortion = -0.05;  ///< k1 of OpenCV's model, both lenses
  double focal_to_width = 0.8;       ///< what the turns and the distortion go by
  double right_exposure = 1.25;      ///< times the left one's, in linear light
  double noise = 4;                  ///< standard deviation a channel, of 255
};

/// A pair as it comes from the cameras, not rectified.
struct PhonePair {
  StereoPair pictures;
  Flow left_to_right;  ///< from each pixel of the left picture to its partner in the right; NaN where it has none
};

/// The synthetic still life as two hand-held cameras side by side take it. The width and height of `pictures` are those
/// of the photographs; a margin around them is cast too, so that turned cameras see the scene everywhere. Throws as
/// make_synthetic_still does.
PhonePair make_phone_pair(const SyntheticStillOptions& pictures, const PhoneCameraOptions& camera = {},
                          const Progress& progress = {});

}  // namespace wheatstone
