#pragma once

#include <span>

#include "wheatstone/motion/flow.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// Throws Error{bad_input} where a scene has no pictures, its images are not of one size, or a disparity is unknown.
void check_fits(std::span<const View> views);

/// Throws Error{bad_input} where a flow has not the size of the scene's reference view.
void check_fits(const FlowPair& flow, std::span<const View> views);

}  // namespace wheatstone
