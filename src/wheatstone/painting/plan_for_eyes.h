#pragma once

#include "wheatstone/gpu/gpu.h"
#include "wheatstone/painting/plan_painting.h"

namespace wheatstone {

/// As plan_frame, for a film that is shown to the eyes of its own views, or to the one view there is. Strokes are drawn
/// once by `device`, and what these views would show wrongly is repaired. The marks are complete: whoever draws them
/// needs nothing else of the frame. What the processor has drawn comes with them: the same bytes as drawing the marks
/// for the eyes, over their pictures if the style says so, with `deep` as DrawOptions has it. Throws also where the
/// device fails (draw.h).
PlannedFrame plan_for_eyes(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress = {}, Device device = Device::processor,
                           bool deep = false);

}  // namespace wheatstone
