#pragma once

#include "wheatstone/painting/painting.h"

namespace wheatstone {

/// Makes everything in a layer `factor` times as large: places, disparities and radii.
void resize_strokes(Layer& layer, float factor);

}  // namespace wheatstone
