#pragma once

#include <cstdint>

#include "wheatstone/marks/style.h"

namespace wheatstone {

/// A colour moved by up to ± half of each jitter: hue, saturation and value first, then red, green and blue.
/// `random` is a hash; the same hash gives the same colour.
Rgb8 jittered(Rgb8 colour, const ColourJitter& jitter, std::uint64_t random);

}  // namespace wheatstone
