#pragma once

#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// Parts the layer's last stroke in two of half the width, one on either side of it, each with the colour that the
/// reference has there (Bukenberger et al. 2015, sec. 4.1): every point is moved by the halves' radius across the
/// stroke's Catmull–Rom tangent. Where a half's colour would be unlike that of one of its places
/// (marks/residual.h), it becomes several strokes, one behind the other. A dot, which has no tangent, stays one.
/// All but the first are parts of it.
void make_dual(const LayerPlan& plan, Layer& layer);

}  // namespace wheatstone
