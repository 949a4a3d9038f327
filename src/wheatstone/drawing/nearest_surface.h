#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The disparity, in pixels, of the nearest of a painting's surfaces at each pixel of a view; NaN where none is known.
Image<float> nearest_surface(const Painting& painting, ViewPosition view);

}  // namespace wheatstone
