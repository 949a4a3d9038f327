#pragma once

#include <span>

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

/// The disparity of the surface that a view shows at a place, interpolated where it is one surface; beyond the border,
/// that of the border.
float surface_disparity(ImageView<const float> disparity, float x, float y, float depth_threshold_px);

/// The column at which a point of one view's pictures stands in those of another.
float column_in(const ControlPoint& point, const SceneView& from, const SceneView& to);

/// True where no surface of the view lies before the point by more than `tolerance_px` of disparity. `from` is the view
/// in which the point stands.
bool is_visible(const ControlPoint& point, const SceneView& from, const SceneView& view, float tolerance_px);

/// Appends a stroke that is seen from everywhere where nothing hides it. `points` are the stroke's own.
void append_everywhere(Stroke stroke, std::span<const ControlPoint> points, Layer& layer);

}  // namespace wheatstone
