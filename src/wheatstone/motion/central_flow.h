#pragma once

#include "wheatstone/motion/flow.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// One of two frames between which things move.
struct MovingMoment {
  const Image<float>& left_disparity;     ///< in the left view's geometry
  const Image<float>& central_disparity;  ///< in the central view's; neither has unknowns
};

/// The central view's flow from the left view's: a point moves in the central view as in the left one, less half the
/// change of its disparity. What the left view does not show moves like the farther of its neighbours on the scan line.
FlowPair central_flow(const FlowPair& left, const MovingMoment& first, const MovingMoment& second);

}  // namespace wheatstone
