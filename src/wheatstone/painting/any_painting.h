#pragma once

#include <vector>

#include "wheatstone/painting/diffusion_curves.h"
#include "wheatstone/painting/painting.h"
#include "wheatstone/painting/polygon_mark.h"
#include "wheatstone/painting/relief.h"

namespace wheatstone {

/// A painting of one kind of marks: areas or curves where these have a size, else strokes. The others are empty, but
/// that `painting` has the size of the pictures always.
struct AnyPainting {
  Painting painting;
  PolygonPainting areas;
  DiffusionPainting curves;
  Relief relief;  ///< of the strokes
  friend bool operator==(const AnyPainting&, const AnyPainting&) = default;
};

/// Draws it for one view as its kind of marks is drawn; strokes over their canvas colour.
DrawnView draw(const AnyPainting& painting, float view);

/// The same, `scale` times as large: sizes are rounded to whole pixels.
AnyPainting resized(AnyPainting painting, double scale);

/// How near each mark is, in no order: the disparities of strokes and areas, and of the points of curves.
std::vector<float> disparities_of_marks(const AnyPainting& painting);

}  // namespace wheatstone
