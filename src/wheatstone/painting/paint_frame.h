#pragma once

#include "wheatstone/gpu/device.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/present.h"

namespace wheatstone {

/// A frame of a film, painted.
struct PaintedFrame {
  Painting painting;
  Presented shown;  ///< the left eye's view and the right one's, or the one view there is
  StrokeCounts counts;
  PaintingTimes times;
};

/// Paints a frame of a film for both eyes, or for the one view there is, and leaves at most single pixels bare. Throws
/// Error{wrong_usage} for a style that cannot be painted with, and where the device that is to draw fails (draw.h).
/// `progress` is called between the steps of planning and drawing. If it throws, painting ends, and `memory` is of no
/// further use.
PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress = {}, Device device = Device::processor);

}  // namespace wheatstone
