#pragma once

#include "wheatstone/image/image.h"
#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// How far to either side of the view in which strokes are planned they will be seen from, in eye separations; 0: only
/// from that view.
struct ViewsBeside {
  float left = 0, right = 0;
  friend bool operator==(const ViewsBeside&, const ViewsBeside&) = default;
};

/// The surfaces on which strokes lie, in the view in which they are planned.
struct StrokeGround {
  ImageView<const float> disparity;  ///< pixels, no unknowns
  float depth_threshold_px;          ///< by which surfaces differ
  ViewsBeside beside;
};

/// The disparity, at most the point's own, with which the paint around a stroke's point stays within the outline of its
/// surface in the views to either side. Paint of a radius moves as its middle does, but the surface recedes towards its
/// outline, which moves less: paint with the middle's disparity would come to lie over what is behind.
float disparity_within_outline(const StrokeGround& ground, const ControlPoint& point, float radius_px);

}  // namespace wheatstone
