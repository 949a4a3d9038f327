#pragma once

#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

/// The strokes of a layer that may cover something of a canvas that is bare; they stand in the canvas's view.
Layer strokes_near_bare(const Layer& layer, const Canvas& canvas);

/// Dots and short threads of the photograph's colours for the pixels of a planner's canvas that no stroke covers, as
/// far as they are wanted: `wanted` is not 0 there, or empty. Each lies on one surface and has that surface's colour.
/// `inputs` are the finest layer's.
Layer cover_bare(const LayerPlanner& planner, const LayerInputs& inputs, const ScaledStyle& scaled, const Style& style,
                 ImageView<const std::uint8_t> wanted);

}  // namespace wheatstone
