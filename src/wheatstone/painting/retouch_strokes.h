#pragma once

#include <span>

#include "wheatstone/marks/painting.h"
#include "wheatstone/stereo/retouch.h"

namespace wheatstone {

/// Does the touches of strokes to a painting, in their order, once for all views. Touches are in pixels of the view
/// that the painting was planned in, which is the left one of a still; those that go on belong to one stroke of the
/// hand.
/// - What is painted is a stroke of the painting's brush, on top of all others. It lies on the surface under it.
/// - Erased are strokes that are at most as wide as the brush and come within its radius, but not those of the coarsest
///   layer, which is the ground.
/// - Recoloured are the same strokes; each keeps its own brightness among them.
/// Paintings without strokes, or without surfaces, stay as they are.
void retouch_strokes(std::span<const Touch> touches, Painting& painting);

/// Whether touches of strokes do anything to a painting.
bool has_strokes_to_retouch(const Painting& painting);

}  // namespace wheatstone
