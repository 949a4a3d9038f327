#pragma once

#include "wheatstone/curves/diffusion_in_time.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/regions/mosaic.h"
#include "wheatstone/regions/posterise.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

/// What any style carries from frame to frame. Empty before the first.
struct PaintingMemory {
  StrokeMemory strokes;
  PosterisedMemory posterised;
  MosaicMemory mosaic;
  DiffusionMemory diffusion;
};

struct PlannedFrame {
  Painting painting;
  StrokeCounts counts;
  std::vector<DrawnView> drawn = {};  ///< of the eyes, or the one view, where plan_for_eyes drew them
};

/// Plans a frame of a film in any style; a still is a film of one frame. The marks of the reference view, which is the
/// first, serve all views; parts that only another view sees are planned in that view. Marks may be drawn from
/// anywhere, because the painting's surfaces, which are the views' disparities, hide them. Throws Error{wrong_usage}
/// for a style that cannot be painted with, Error{bad_input} where the views do not fit together. If `progress` throws,
/// planning ends, and `memory` is of no further use. `fits`: as plan_strokes'.
PlannedFrame plan_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options, PaintingMemory& memory,
                        const Progress& progress = {}, StrokeFits* fits = nullptr);

}  // namespace wheatstone
