#pragma once

#include "wheatstone/marks/spots_of_view.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Lays dots and short threads of the photograph's colours over the spots, on top of the finest layer.
void add_accents(const SpotsOfView& spots, const Style& style, StrokePainting& painting);

}  // namespace wheatstone
