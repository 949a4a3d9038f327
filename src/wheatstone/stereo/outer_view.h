#pragma once

#include <span>

#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// A view beside the eyes, or between them. It shows what the photographs show of it. Its other pixels are its wanted
/// ones: there, the farther neighbouring surface continues, with its colours mirrored. `eyes` are the left and the
/// right photograph with their disparities, of one size and scale; the view has both. Its frame is shifted so that a
/// point of the disparity `zero_parallax_px`, in pixels of the reference view, has about the same column in it as in
/// the central view: the pictures show what a display shows.
View make_outer_view(std::span<const View> eyes, ViewPosition position, float zero_parallax_px);

}  // namespace wheatstone
