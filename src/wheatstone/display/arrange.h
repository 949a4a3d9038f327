#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Left and right next to each other at full size, left on the left.
Image<Rgb8> side_by_side(const StereoPair& pair);

/// Moves the zero-parallax plane to where the disparity is `zero_parallax_px` (Stavrakis & Gelautz 2004, sec. 3.4): the
/// pictures are shifted against each other by that many whole pixels and cropped to what both show, the same height and
/// at least one column. Points nearer than the plane then stand in front of the screen.
StereoPair translated(const StereoPair& pair, float zero_parallax_px);

}  // namespace wheatstone
