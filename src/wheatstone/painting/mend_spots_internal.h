#pragma once

#include <span>

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// Draws each photographed view of a painting of regions, and adds marks where its colour is one that the
/// photograph has nowhere near: small things that were joined to large ones, colours that spread too far, and, in other
/// views than the reference, marks whose disparity is wrong. Those of the reference view are for all views, those of
/// another one only for views about it. The painting has its surfaces.
void mend_spots(std::span<const SceneView> views, const Style& style, Painting& painting);

}  // namespace wheatstone
