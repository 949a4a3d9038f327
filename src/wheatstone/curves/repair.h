#pragma once

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/repair_target.h"

namespace wheatstone {

/// Draws lines of the photograph's colours over the places, row by row, and over a rim about them: what spreads from
/// there is what belongs beside them.
void repair(const RepairTarget& target, DiffusionPainting& painting);

}  // namespace wheatstone
