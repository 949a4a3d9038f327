#pragma once

#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

/// Dots of the photograph's colours for the pixels of a planner's canvas that no stroke covers, as far as they are
/// wanted: `wanted` is not 0 there, or empty. Each lies on one surface.
Layer cover_bare(const LayerPlanner& planner, const ScaledStyle& scaled, const Style& style,
                 ImageView<const std::uint8_t> wanted);

}  // namespace wheatstone
