#pragma once

#include <optional>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Disparities of a pair, in its pixels, as far as few and sure matches show them.
struct SeenDisparities {
  float least = 0, largest = 0;
};

/// None where the pair gives nothing to go by.
std::optional<SeenDisparities> find_seen_disparities(const StereoPair& pair);

}  // namespace wheatstone
