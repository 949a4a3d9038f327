#pragma once

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// Gives the other eye its part of a layer that was planned in one eye. A stroke whose points are all visible to both
/// may appear in both; where a control point lies on an occluded pixel the stroke is split, and the occluded part stays
/// with the eye that sees it (Stavrakis & Gelautz 2005, sec. 3.2). `occlusion` is the reference view's mask, not
/// dilated.
Layer propagate_to_other_eye(const Layer& planned, ImageView<const std::uint8_t> occlusion);

}  // namespace wheatstone
