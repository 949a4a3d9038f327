#pragma once

#include <span>

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// Adds small marks where a photographed view would show a colour that its photograph has nowhere near. Paintings of
/// regions and of lines are drawn and looked at: small things may have been joined to large ones, colours be missing,
/// and no edge may bound what differs (lines beside a central reference view are looked at in that one only). Strokes
/// and lines are mended in other views than the reference, too, where its colours contradict the view's because a
/// disparity is wrong. What is wrong in the reference view is mended for all views, else for those about the view.
/// Paintings of tiles, those whose colours are changed at random, and those of eyes apart are left as they are. The
/// painting has its surfaces.
void mend_spots(std::span<const SceneView> views, const Style& style, Painting& painting);

}  // namespace wheatstone
