#pragma once

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// The strokes of a layer that may cover something bare; they stand in the mask's view.
Layer strokes_near_bare(const Layer& layer, ImageView<const std::uint8_t> bare);

}  // namespace wheatstone
