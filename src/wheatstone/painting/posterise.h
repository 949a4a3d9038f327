#pragma once

#include "wheatstone/painting/polygon_mark.h"
#include "wheatstone/painting/style.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A pair as areas of few colours (Bukenberger et al. 2015, sec. 4.2): the pixels are clustered in RGB by k-means into
/// `style.colours` colours, connected pixels of one colour and one surface become a polygon. Both eyes show the areas
/// of the left one; what only the right eye sees is cut there, into the same colours. Throws Error: bad_input where the
/// geometry does not fit, wrong_usage for a style that cannot be painted with.
PolygonPainting plan_posterised(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style);

}  // namespace wheatstone
