#pragma once

#include "wheatstone/painting/painting.h"
#include "wheatstone/painting/style.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Plans what only the right eye sees: strokes that begin on its grown occlusion mask, in all layers (Stavrakis &
/// Gelautz 2005, sec. 3.2). They are planned against a canvas that holds nothing else, from the photograph reduced to
/// half its size: the part is small, and its cost is mostly that of looking at pictures. The layers are in full-size
/// pixels, each in drawing order, their strokes not yet propagated.
Painting plan_occluded_part(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style);

}  // namespace wheatstone
