#pragma once

#include <cstdint>
#include <span>

#include "wheatstone/strokes/begun_canvas_internal.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {

/// Strokes away from depth edges, or those beside them.
enum class Place { open, beside_edge };

/// Where one stroke is set down, and how wide it is.
struct Seed {
  float error = -1;
  int x = 0, y = 0;
};

/// How a stroke sets out from its seed.
struct StrokeStart {
  Seed seed;
  float radius_px = 1;     ///< of the stroke
  bool backwards = false;  ///< which of the two senses of the first direction it takes
};

/// The radius of a stroke that begins at a seed: the layer's, or beside a depth edge what fits.
float stroke_radius(const LayerPlan& plan, Place place, const Seed& seed);

/// Smooths the disparities of a stroke's points, and in the finest layer keeps its paint within its surface's outline.
void settle_disparities(const LayerPlan& plan, float radius_px, std::span<ControlPoint> points);

/// Error of a bare pixel: above every squared RGB distance (at most 3·255²), with room below it for a preference.
inline constexpr float bare_error = 1e6f;

/// Columns [begin, end) of one row of a picture.
struct RowPart {
  int row, begin, end;
};

/// Squared RGB distances between reference and canvas, `bare_error` where the canvas is bare; `errors` has the canvas's
/// width, and only the part's columns are written.
void squared_errors(const ReferencePicture& reference, const CanvasRows& rows, const RowPart& part, float* errors);

}  // namespace wheatstone
