#pragma once

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/spots_of_view.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Lays small regions over the spots, each of one of the painting's colours, or of new ones as long as the painting has
/// no more than the style wants.
void add_accents(const SpotsOfView& view, const Style& style, RegionPainting& painting);

}  // namespace wheatstone
