#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/motion/film_frame.h"

namespace wheatstone {

/// The distance from a depth edge within which it is uncertain which surface is seen.
inline constexpr float depth_edge_px = 2;

/// How far a point moves, in pixels of its view.
struct PointStep {
  float x = 0, y = 0;
  bool confirmed = false;  ///< forward and backward flow agree on it
};

/// The motion of the points of all views of a scene from the frame before to this one, from the flow of the reference
/// view alone. A point that is hidden in that view moves like the closest place on its scan line whose surface is not
/// nearer to the viewer than the point.
class SceneMotion {
 public:
  /// `disparity_before` is the reference view's at the frame before; all is borrowed, and the frame has a flow.
  SceneMotion(const FilmFrame& frame, ImageView<const float> disparity_before, float depth_threshold_px);

  /// The step of a point that stands in the view.
  PointStep of(const ControlPoint& point, ViewPosition view) const;

  /// Whether the reference view showed all of a stroke of another view at the frame before, including the width of its
  /// paint.
  bool showed_whole(std::span<const ControlPoint> points, float radius_px, ViewPosition view) const;

  ViewPosition reference() const { return reference_; }

 private:
  const FlowPair& flow_;
  ImageView<const float> disparity_before_;
  ViewPosition reference_;
  float depth_threshold_px_;
};

}  // namespace wheatstone
