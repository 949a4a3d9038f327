#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// Moves the strokes of a still in depth where the disparity of its left view changes from `before` to `after`, maps of
/// the painting's size without unknown pixels. This takes a few hundredths of a second, so that a hand sees at once
/// what it does; plan_again then plans the strokes for the new depth. Each point keeps its place in the left view, and
/// moves with the surface that it lies on; what another surface hides there stays. Other marks stay as they are.
void follow_disparity(ImageView<const float> before, ImageView<const float> after, Painting& painting);

}  // namespace wheatstone
