#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Throws Error{bad_input} where pictures and disparity that are to be measured differ in size.
void check_one_size(const StereoPairView& pair, ImageView<const float> left_disparity);

}  // namespace wheatstone
