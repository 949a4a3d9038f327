#pragma once

#include <span>

#include "wheatstone/stereo/view.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// Drops the fading strokes of the view at `home` that would show one of the views, where no surface of that view hides
/// them, a colour that its picture has nowhere near (marks/residual.h). Views of what no photograph shows are not
/// asked.
void drop_misplaced(ViewPosition home, std::span<const View> views, float depth_threshold_px, TrackedLayer& tracked);

}  // namespace wheatstone
