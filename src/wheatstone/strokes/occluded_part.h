#pragma once

#include <vector>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// An occlusion mask of a view, grown as the style says: where the paint of what only this view sees may begin.
Image<std::uint8_t> grown_occlusion(ImageView<const std::uint8_t> occlusion, const Style& style);

/// Plans what only one view sees: strokes that begin where it is wanted, grown, in all layers (Stavrakis & Gelautz
/// 2005, sec. 3.2). They are planned against a canvas that holds nothing else, from the photograph reduced to half its
/// size: the part is small, and its cost is mostly that of looking at pictures. Each layer is in drawing order, its
/// strokes not yet propagated. The view is of full size.
std::vector<Layer> plan_occluded_part(View view, const Style& style);

}  // namespace wheatstone
