#pragma once

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// 255 where a canvas is bare, as far as it is wanted: `wanted` is not 0 there, or empty.
Image<std::uint8_t> bare_pixels(const Canvas& canvas, ImageView<const std::uint8_t> wanted);

/// The strokes of a layer that may cover something bare; they stand in the mask's view.
Layer strokes_near_bare(const Layer& layer, ImageView<const std::uint8_t> bare);

}  // namespace wheatstone
