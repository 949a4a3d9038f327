#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// How far the views for which strokes are planned reach to either side of the one that they are planned in, in eye
/// separations; 0: strokes are seen from there only.
struct ViewsBeside {
  float left = 0, right = 0;
};

/// What strokes lie on in the view in which they are planned.
struct StrokeGround {
  ImageView<const float> disparity;  ///< pixels, no unknowns
  float depth_threshold_px;          ///< by which surfaces differ
  ViewsBeside beside;
};

/// The disparity of a stroke's point with which the paint around it stays within the outline of its surface in the
/// views to either side, at most the point's own. Paint of a radius moves as its middle does, but the surface recedes
/// towards its outline, which moves less: paint with the middle's disparity would come to lie over what is behind.
float disparity_within_outline(const StrokeGround& ground, const ControlPoint& point, float radius_px);

}  // namespace wheatstone
