#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Throws Error{bad_input} unless photographs and geometry are of one size, not empty, and every disparity is known.
void check_fits(const StereoPair& photographs, const StereoGeometry& geometry);

}  // namespace wheatstone
