#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// A stroke as the rasteriser wants it: a chain of straight segments in one view.
struct FlatStroke {
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;  ///< one for a dot
  float radius_px = 0;
  float opacity = 1;
  float red = 0, green = 0, blue = 0;  ///< 0..255
  float disparity = 0;
  float top = 0, bottom = 0;  ///< the rows its chain spans, without the radius
};

/// The strokes of one layer that one view shows, in drawing order; vertices as a structure of arrays.
struct FlatLayer {
  std::vector<float> x, y;
  std::vector<FlatStroke> strokes;
};

/// Bends every stroke's cubic B-spline (clamped: it begins and ends at its outer control points) into segments that
/// leave the curve by less than an eighth of a pixel.
FlatLayer flatten(const Layer& layer, ViewPosition view);

}  // namespace wheatstone
