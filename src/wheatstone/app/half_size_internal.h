#pragma once

#include "wheatstone/marks/painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

// Strokes are as smooth at any size: planned on frames of half the width and height, which are a quarter of the work,
// they are drawn at the film's own size.

/// Whether a painting of frames so wide may be planned at half their size: it consists of strokes, and there its finest
/// brush is still wide enough for what it shows.
bool may_be_planned_at_half_size(const Style& style, int width);

/// The style as frames of half the size are painted with it.
Style at_half_size(Style style);

/// Every two by two pixels become their mean. Odd sizes are rounded up: the last row or column stands for two.
StereoPair at_half_size(const StereoPair& eyes);

/// The range that holds the same disparities, in pixels of half the size.
DisparityRange at_half_size(const DisparityRange& range);

/// A painting that was planned at half the size of frames, at their own.
Painting at_whole_size(Painting painting, PictureSize frame, const Style& style);

}  // namespace wheatstone
