#pragma once

#include <span>

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// The edges of a scene as diffusion curves (Orzan et al. 2013), as dual strokes with a radius and an offset of a pixel
/// (Bukenberger et al. 2015, sec. 4.2). All views show the lines of the reference view, the first; what it does not
/// show has lines of its own. Where a surface goes behind another, each view that sees it there adds a line on the
/// farther side. With Propagation::independent each view is planned alone. Throws Error: bad_input where pictures,
/// disparities and masks do not fit together or a disparity is unknown, wrong_usage for a style that cannot be painted
/// with.
DiffusionPainting plan_diffusion(std::span<const View> views, const Style& style);

}  // namespace wheatstone
