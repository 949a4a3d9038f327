#pragma once

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

// The naive methods against which propagated marks are measured.

/// Plans all of one view by itself, with strokes.
StrokePainting plan_by_itself(View view, const Style& style, const Progress& progress);

/// Plans each eye by itself; with Propagation::raster, of strokes, the right eye for what it alone sees. A mark may be
/// drawn in its own eye only, and there are no surfaces.
Painting plan_eyes_apart(const StereoPairView& photographs, const StereoGeometryView& geometry, const Style& style,
                         const Progress& progress);

}  // namespace wheatstone
