#pragma once

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// Lights a picture's relief by a lamp above and to the left: brighter where it turns to the lamp, darker where it
/// turns away; flat paint keeps its colour. `relief` has the picture's size; `depth_px` is the height of 1 in pixels.
void light_relief(const Image<float>& relief, float depth_px, Image<Rgb8>& picture);
void light_relief(const Image<float>& relief, float depth_px, Image<Rgb16>& picture);

/// The relief of a style's paint in a picture `width` wide; none for a style without texture.
Relief relief_for(const Style& style, int width);

}  // namespace wheatstone
