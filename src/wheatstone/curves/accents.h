#pragma once

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/spots_of_view.h"

namespace wheatstone {

/// Draws lines of the photograph's colours over the spots, row by row, and over a rim about them: what spreads from
/// there is what belongs beside them.
void add_accents(const SpotsOfView& view, DiffusionPainting& painting);

}  // namespace wheatstone
