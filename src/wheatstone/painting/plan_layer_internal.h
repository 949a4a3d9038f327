#pragma once

#include "wheatstone/painting/plan_layer.h"

namespace wheatstone {

/// Error of a bare pixel: above every squared RGB distance (at most 3·255²), with room below it for a preference.
inline constexpr float bare_error = 1e6f;

/// Squared RGB distances between reference and canvas for one row, `bare_error` where the canvas is bare; `errors` has
/// the canvas's padded width.
void squared_errors(const ReferencePicture& reference, const Canvas& canvas, int row, float* errors);

}  // namespace wheatstone
