#pragma once

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/drawing/prepared_strokes_internal.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The height of the paint of every pixel as one view sees it, 0 on the bare canvas, about 1 on the ridges (Hertzmann
/// 2002, fast paint texture): each stroke has the bristles of its brush along it, and lies on what is below it, in
/// drawing order. The bristles belong to the stroke, so that all views see the same. The same bytes on any number of
/// threads.
Image<float> relief_of(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding = {},
                       float bristle_px = Relief{}.bristle_px);

/// Lights the paint of a view as it was drawn, in all its pictures; without relief it stays as it is.
void light_paint(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, const Relief& relief,
                 DrawnView& drawn);

}  // namespace wheatstone
