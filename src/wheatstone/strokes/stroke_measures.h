#pragma once

#include <cstddef>
#include <span>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How well the strokes of the two eyes belong together. Numbers of strokes count a dual stroke once, by its first
/// part; shares are of all parts.
struct StrokeMeasures {
  std::size_t strokes = 0;
  std::size_t visible_to_both = 0;  ///< no control point lies on an occluded pixel of the stroke's own view
  double paired_share = 0;          ///< of those visible to both, 0..1, the ones that appear in both eyes
  double shape_differs_share = 0;  ///< of those in both eyes, the ones whose length differs by over a tenth and a pixel
};

StrokeMeasures measure_strokes(std::span<const Layer> layers, const StereoGeometry& geometry);

}  // namespace wheatstone
