#pragma once

#include <cstdint>

#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/study/simulated_display.h"

namespace wheatstone {

/// On which side a ring is open.
enum class RingGap { right, below, left, above };

struct RandomDotOptions {
  float disparity_arcsec = 400;  ///< of the ring against the screen; above 0 it stands in front
  float ring_mm = 90;            ///< outer diameter; it is a fifth as thick, and so is its gap (Landolt)
  float dot_mm = 1;
  float dots_share = 0.5f;  ///< of the area, were the dots not to overlap
};

/// A random-dot stereogram for testing people's stereoscopic vision (Julesz 1971): a Landolt ring that only both eyes
/// together see. Dots lie at any place between pixels, so that a disparity may be less than a pixel. The right answer
/// is `gap`.
StereoPair random_dot_stereogram(const RandomDotOptions& options, const StudyScreen& screen, RingGap gap,
                                 std::uint64_t seed);

}  // namespace wheatstone
