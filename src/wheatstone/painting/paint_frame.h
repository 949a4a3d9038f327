#pragma once

#include "wheatstone/curves/diffusion_in_time.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/painting/paint.h"
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

/// A frame of a film, painted. Of a scene of one view, `pictures.right` is empty.
struct PaintedFrame {
  PaintedPair painted;
  StrokeCounts counts;
};

/// Paints a frame of a film for both eyes, or for the one view there is, and leaves no pixel bare. Throws
/// Error{wrong_usage} for a style that cannot be painted with. What `progress` throws, between the steps of planning
/// and drawing, ends it: then `memory` is of no further use.
PaintedFrame paint_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                         PaintingMemory& memory, const Progress& progress = {});

}  // namespace wheatstone
