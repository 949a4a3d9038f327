#pragma once

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/repair_target.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Lays small regions over the places, each of one of the painting's colours, or of new ones as long as the painting
/// has no more than the style wants.
void repair(const RepairTarget& target, const Style& style, RegionPainting& painting);

}  // namespace wheatstone
