#pragma once

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// The height of the paint of every pixel as one view sees it, 0 on the bare canvas, about 1 on the ridges (Hertzmann
/// 2002, fast paint texture): each stroke has the bristles of its brush along it, and lies on what is below it, in
/// drawing order. The bristles belong to the stroke, so that both eyes see the same. The same bytes on any number of
/// threads.
Image<float> relief_of(const StrokePainting& painting, ViewPosition view, float bristle_px = Relief{}.bristle_px);

/// Lights a picture's relief by a lamp above and to the left: brighter where it turns to the lamp, darker where it
/// turns away; flat paint keeps its colour. `relief` has the picture's size; `depth_px` is the height of 1 in pixels.
void light_relief(const Image<float>& relief, float depth_px, Image<Rgb8>& picture);

/// Lights the paint of a view as it was drawn; without relief it stays as it is.
void light_paint(const StrokePainting& painting, ViewPosition view, const Relief& relief, Image<Rgb8>& picture);

/// The relief of a style's paint in a picture `width` wide; none for a style without texture.
Relief relief_for(const Style& style, int width);

}  // namespace wheatstone
