#pragma once

#include "wheatstone/painting/diffusion_in_time.h"
#include "wheatstone/painting/moment.h"
#include "wheatstone/painting/mosaic.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/posterise.h"
#include "wheatstone/painting/strokes_in_time.h"

namespace wheatstone {

/// What any style carries from moment to moment. Empty before the first.
struct MomentMemory {
  StrokeMemory strokes;
  PosterisedMemory posterised;
  MosaicMemory mosaic;
  DiffusionMemory diffusion;
};

/// A moment of a film, painted. Of a scene of one view, `pictures.right` is empty.
struct PaintedMoment {
  PaintedPair painted;
  StrokeCounts counts;
};

/// Paints a moment of a film for both eyes, or for the one view there is, and leaves no pixel bare. Throws
/// Error{wrong_usage} for a style that cannot be painted with.
PaintedMoment paint_moment(const Moment& moment, const Style& style, const CarryOptions& options, MomentMemory& memory);

}  // namespace wheatstone
