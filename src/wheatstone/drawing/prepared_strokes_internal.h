#pragma once

#include <vector>

#include "wheatstone/drawing/rasterise_internal.h"

namespace wheatstone {

/// A layer, flattened and sorted into bands of rows.
struct BandedLayer {
  FlatLayer flat;
  std::vector<std::vector<std::uint32_t>> bands;
  Brush brush = {};
};

/// Everything in a painting of strokes that is the same in all views: a view only moves vertices along their rows.
struct PreparedStrokes {
  int width, height;
  Rgb8 canvas_colour;
  std::vector<BandedLayer> layers;
  float bare_light;  ///< a pixel that lets more through is bare
  bool canvas_shows;
};

}  // namespace wheatstone
