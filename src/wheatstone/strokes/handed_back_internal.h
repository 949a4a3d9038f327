#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// Strokes that were planned in a view's own pixels, in those of the reference view: places, disparities and radii.
void hand_back(const ViewFrame& frame, Layer& layer);

/// The other way: strokes in the reference view's pixels, in the view's own.
void take_in(const ViewFrame& frame, Layer& layer);

}  // namespace wheatstone
