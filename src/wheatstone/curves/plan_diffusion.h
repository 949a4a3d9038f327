#pragma once

#include <span>

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// The edges of a scene as diffusion curves (Orzan et al. 2013), as dual strokes with a radius and an offset of a pixel
/// (Bukenberger et al. 2015, sec. 4.2). All views show the lines of the reference view, the first, but for those on the
/// side of a view where something hides them: where a view's disparity, at the place that a point goes to, is larger by
/// more than the depth threshold. Where a surface goes behind another, the line on the farther side belongs to the view
/// that sees it there; what the reference view does not show has lines of its own. With Propagation::independent each
/// view is planned alone. Throws Error: bad_input where pictures, disparities and masks do not fit together or a
/// disparity is unknown, wrong_usage for a style that cannot be painted with.
DiffusionPainting plan_diffusion(std::span<const SceneView> views, const Style& style);

/// The same of a pair, with the left eye as reference view.
DiffusionPainting plan_diffusion(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                 const Style& style);

}  // namespace wheatstone
