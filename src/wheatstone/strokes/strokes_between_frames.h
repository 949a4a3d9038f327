#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// What became of the strokes from one frame of a painted film to the next, told from what is drawn alone, by the
/// strokes' numbers. A dual stroke counts once, by its first part; any of its parts may pop.
struct StrokeChanges {
  std::int64_t whole = 0;     ///< strokes of the first frame that are not fading, that is, as opaque as the paint is
  std::int64_t survived = 0;  ///< of these, whole in the second
  std::int64_t hidden = 0;    ///< whole in the first and not there in the second: out of the picture, or hidden
  std::int64_t popped = 0;    ///< whose opacity changes by more than the largest step, or that begin with more
};

/// `largest_step` is a share of the paint's opacity, which is that of the most opaque stroke of each frame: 1/fade, of
/// the shorter fade. Strokes need numbers.
StrokeChanges compare_strokes(std::span<const Layer> first, std::span<const Layer> second, double largest_step);

}  // namespace wheatstone
