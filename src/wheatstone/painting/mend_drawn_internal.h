#pragma once

#include <cstddef>
#include <span>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// True for paintings of strokes that are mended when they are drawn: what is wrong is then known, whatever made it.
/// Not for those whose colours are changed at random, or whose paint is lit, those of eyes apart, and narrow ones.
bool is_mended_when_drawn(const Painting& painting, const Style& style);

/// Adds strokes where the pictures that were drawn of a painting show a colour that the view's photograph has nowhere
/// near, and draws them over the pictures. `shown` has the number of each picture's view. The strokes are for the view
/// that was looked at and those about it, or for all where that is the reference view, the first.
void mend_drawn(std::span<const SceneView> views, std::span<const std::size_t> shown, const Style& style,
                Painting& painting, std::span<DrawnView> pictures);

}  // namespace wheatstone
