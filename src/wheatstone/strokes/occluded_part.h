#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"

namespace wheatstone {

/// An occlusion mask of a view, grown as the style says: where the paint of what only this view sees may begin.
Image<std::uint8_t> grown_occlusion(ImageView<const std::uint8_t> occlusion, const Style& style);

/// Plans what only one view sees: strokes that begin on its grown occlusion mask, in all layers (Stavrakis & Gelautz
/// 2005, sec. 3.2). They are planned against a canvas that holds nothing else, from the photograph reduced to half its
/// size: the part is small, and its cost is mostly that of looking at pictures. The layers are in full-size pixels,
/// each in drawing order, their strokes not yet propagated. Photograph, disparity and mask are of one size.
StrokePainting plan_occluded_part(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                                  ImageView<const std::uint8_t> occlusion, ViewPosition view, const Style& style);

}  // namespace wheatstone
