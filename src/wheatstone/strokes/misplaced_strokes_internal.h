#pragma once

#include <span>

#include "wheatstone/stereo/view.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// Drops the fading strokes of the view at `home` that would show a wrong colour in one of the views: the stroke is not
/// hidden by that view's surfaces, and the view's picture has its colour nowhere near (marks/residual.h). Views without
/// a photograph are not examined.
void drop_misplaced(ViewPosition home, std::span<const View> views, float depth_threshold_px, TrackedLayer& tracked);

}  // namespace wheatstone
