#pragma once

#include <cstdint>

#include "wheatstone/marks/style.h"

namespace wheatstone {

/// A colour moved by up to ± half of each jitter. In OKLab first: the hue as a share of the circle, the saturation as a
/// share of the most chroma that sRGB has there; both keep the lightness. A negative chroma is that of the opposite
/// hue, and a grey may get any hue. Then the value of HSV, and red, green and blue, as shares of their range. `random`
/// is a hash; the same hash gives the same colour.
Rgb8 jittered(Rgb8 colour, const ColourJitter& jitter, std::uint64_t random);

}  // namespace wheatstone
