#pragma once

#include <vector>

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// How a painting's paint stands up from the canvas.
struct Relief {
  float depth_px = 0;       ///< height of 1; 0: no relief
  float bristle_px = 1.6f;  ///< width that a bristle leaves
  friend bool operator==(const Relief&, const Relief&) = default;
};

/// A painting of one kind of marks: regions or curves where these have a size, else strokes. The other kinds are
/// empty; `strokes` always has the size of the pictures.
struct Painting {
  StrokePainting strokes;
  RegionPainting regions;
  DiffusionPainting curves;
  Relief relief;  ///< of the strokes
  friend bool operator==(const Painting&, const Painting&) = default;
};

/// The painting, `scale` times as large: sizes are rounded to whole pixels.
Painting resized(Painting painting, double scale);

/// How near each mark is, in no order: the disparities of strokes and regions, and of the points of curves.
std::vector<float> disparities_of_marks(const Painting& painting);

}  // namespace wheatstone
