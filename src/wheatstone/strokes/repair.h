#pragma once

#include "wheatstone/marks/repair_target.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// The places that are to be repaired with strokes, and how small these may be.
struct StrokeRepair {
  RepairTarget target;
  ScaledStyle scaled;                                ///< in the target's pixels
  ImageView<const std::uint8_t> mixed_colours = {};  ///< not 0 where two surfaces' colours mix; may be empty
};

/// Dots and short threads of the picture's colours over the places, row by row. Each lies on one surface and has that
/// surface's colour.
Layer repair(const StrokeRepair& repair, const Style& style);

}  // namespace wheatstone
