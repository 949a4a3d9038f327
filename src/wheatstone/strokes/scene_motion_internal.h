#pragma once

#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/motion/film_frame.h"

namespace wheatstone {

/// Beside a depth edge, so far, it is not sure which surface is seen.
inline constexpr float depth_edge_px = 2;

/// How far a point moves, in pixels of its view.
struct PointStep {
  float x = 0, y = 0;
  bool confirmed = false;  ///< forward and backward flow agree on it
};

/// Where the points of all views of a scene go from the frame before to this one, by the flow of the reference view
/// alone. What that view hides moves like the nearest part of its scan line that is not nearer than the point.
class SceneMotion {
 public:
  /// `disparity_before` is the reference view's at the frame before; all is borrowed, and the frame has a flow.
  SceneMotion(const FilmFrame& frame, ImageView<const float> disparity_before, float depth_threshold_px);

  /// Of a point that stands in the view.
  PointStep of(const ControlPoint& point, ViewPosition view) const;

  /// True where the reference view showed all of a stroke of another view at the frame before, as wide as its paint
  /// reaches to either side.
  bool showed_whole(std::span<const ControlPoint> points, float radius_px, ViewPosition view) const;

  ViewPosition reference() const { return reference_; }

 private:
  const FlowPair& flow_;
  ImageView<const float> disparity_before_;
  ViewPosition reference_;
  float depth_threshold_px_;
};

}  // namespace wheatstone
