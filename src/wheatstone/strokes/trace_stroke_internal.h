#pragma once

#include <vector>

#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {

/// Follows the picture from a seed pixel (Hertzmann 1998, makeSplineStroke; Stavrakis & Gelautz 2004, sec. 3.3):
/// control points one layer radius R apart, across the gradient of the reference's luminance, until the stroke is long
/// enough, would make the picture worse, finds no direction, leaves the picture, or comes to a depth discontinuity.
/// `backwards` chooses between the two senses of the first direction. Appends at least one point.
void trace_stroke(const LayerPlan& plan, const Style& style, const Seed& seed, float radius_px, bool backwards,
                  std::vector<ControlPoint>& points);

}  // namespace wheatstone
