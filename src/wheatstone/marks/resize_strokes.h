#pragma once

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Makes everything in a layer `factor` times as large: places, disparities and radii.
void resize_strokes(Layer& layer, float factor);

}  // namespace wheatstone
