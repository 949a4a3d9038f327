#pragma once

#include <vector>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// An occlusion mask of a view, grown as the style says: the places where strokes of parts that only this view sees may
/// begin.
Image<std::uint8_t> grown_occlusion(ImageView<const std::uint8_t> occlusion, const Style& style);

/// Plans the part that only one view sees: strokes of all layers, which begin in the grown wanted mask (Stavrakis &
/// Gelautz 2005, sec. 3.2). They are planned on a canvas that holds nothing else, from the photograph at half its size,
/// because the part is small and most of its cost is reading pictures. Each layer is in drawing order, its strokes not
/// yet propagated. The view is of full size.
std::vector<Layer> plan_occluded_part(View view, const Style& style);

}  // namespace wheatstone
