#pragma once

#include <span>
#include <vector>

#include "wheatstone/marks/spline.h"

namespace wheatstone {

/// A cubic Bézier curve.
struct BezierCurve {
  PlanePoint begin, first, second, end;
};

/// As few curves, each beginning where the last one ends, as come within `tolerance_px` of all points of a dense chain
/// (after Schneider 1990, "An Algorithm for Automatically Fitting Digitized Curves"). Nothing for fewer than two
/// places.
std::vector<BezierCurve> fit_curves(std::span<const PlanePoint> chain, float tolerance_px);

}  // namespace wheatstone
