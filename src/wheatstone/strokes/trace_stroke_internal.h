#pragma once

#include <vector>

#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {

/// Follows the picture from the seed pixel (Hertzmann 1998, makeSplineStroke; Stavrakis & Gelautz 2004, sec. 3.3):
/// control points one layer radius R apart, across the gradient of the reference's luminance, until the stroke is long
/// enough, would make the picture worse, finds no direction, leaves the picture, or comes to a depth discontinuity or
/// to where the picture's colour is unlike its own.
/// Appends at least one point. `rows` has those within `traced_reach_px` of the seed.
void trace_stroke(const LayerPlan& plan, const CanvasRows& rows, const StrokeStart& start,
                  std::vector<ControlPoint>& points);
int traced_reach_px(const LayerPlan& plan);

}  // namespace wheatstone
