#pragma once

#include <span>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// The disparity of the surface that a view shows at a place, interpolated where it is one surface; beyond the border,
/// that of the border.
float surface_disparity(ImageView<const float> disparity, float x, float y, float depth_threshold_px);

/// True where no surface of the view lies before the point by more than `tolerance_px` of disparity. The point stands
/// in the view at `from`.
bool is_visible(const ControlPoint& point, ViewPosition from, const View& view, float tolerance_px);

/// Appends a stroke that is seen from everywhere where nothing hides it. `points` are the stroke's own.
void append_everywhere(Stroke stroke, std::span<const ControlPoint> points, Layer& layer);

}  // namespace wheatstone
