#pragma once

#include "wheatstone/painting/plan_polygons_internal.h"

namespace wheatstone {

/// The tiles of one view as regions: connected, each on one surface.
RegionMap lay_tiles(const ViewToCut& view, float tile_px);

}  // namespace wheatstone
