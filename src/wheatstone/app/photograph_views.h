#pragma once

#include "wheatstone/app/display_views.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The views of a photograph for a display, not painted: each shows what the photographs show of it; elsewhere, the
/// farther neighbouring surface continues (make_outer_view). Screen plane, span and framing are chosen as for a
/// painting (plan_display). `stretch` is that of the views' pixels, as ShownPart has it. The geometry has no unknowns.
/// Throws Error{wrong_usage} as plan_display does.
std::vector<Image<Rgb8>> draw_photograph_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                               const DisplayViewsOptions& options, double stretch = 1,
                                               const Progress& progress = {});

}  // namespace wheatstone
