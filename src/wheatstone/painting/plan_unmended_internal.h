#pragma once

#include "wheatstone/painting/plan_painting.h"

namespace wheatstone {

/// As plan_painting, but wrong spots are left for mend_spots or mend_drawn.
PlannedFrame plan_unmended(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress = {});

}  // namespace wheatstone
