#pragma once

#include <cstdint>

#include "wheatstone/image/image.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// The left eye's picture with 16 bits a channel, and how many of its pixels lie side by side in one of the reference
/// view.
struct DeepPicture {
  ImageView<const Rgb16> left;
  float scale = 1;
};

/// Gives new strokes, whose numbers come after `last_number`, the picture's own colour around their first and their
/// last point, where that is less than a level from the stroke's. Farther away, less of the difference is added, and
/// none from two levels on: such a place is not plain, and the colour of its stroke is a choice among many.
void refine_colours(const DeepPicture& picture, std::uint32_t last_number, Layer& layer);

}  // namespace wheatstone
