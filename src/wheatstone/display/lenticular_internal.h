#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/display/lenticular.h"

namespace wheatstone {

/// Where a row's sub-pixels are under their lenses, in parts of 2^64 of a lens: whole lenses drop out where sums wrap
/// around, without a division or a branch. Counted so that views lie in order, the first view first.
struct Phases {
  std::uint64_t first;       ///< of the row's first sub-pixel
  std::uint64_t a_subpixel;  ///< from each to the next
};

Phases phases_of_row(const LenticularScreen& screen, int y);

/// The sample of a smaller picture where sample `i` of `count` is in the larger one: the middles' places agree.
int nearest_sample(int i, int count, int smaller);

/// ⌊phase · views⌋, from the phase's upper half.
inline std::uint16_t view_at(std::uint64_t phase, std::uint32_t views) {
  return static_cast<std::uint16_t>((phase >> 32) * views >> 32);
}

/// The views of a row's sub-pixels, from left to right.
void views_of_phases(const Phases& phases, std::uint32_t views, std::span<std::uint16_t> shown);

}  // namespace wheatstone
