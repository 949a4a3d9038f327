#pragma once

#include <algorithm>
#include <span>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// A point of a picture plane, in pixels.
struct PlanePoint {
  float x = 0;
  float y = 0;
  friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// A point of the scene: where the central view sees it, in pixels, and its disparity. The view at v sees it at
/// x − v · disparity.
struct SpatialPoint {
  float x = 0;
  float y = 0;
  float disparity = 0;
};

inline PlanePoint seen_from(const SpatialPoint& point, ViewPosition view) {
  return {point.x - (view - central_view) * point.disparity, point.y};
}

/// The cubic uniform B-spline of one stroke, clamped: the outer control points stand three times, so that the curve
/// begins and ends on them. A stroke of one point has no spans.
class ClampedSpline {
 public:
  ClampedSpline(std::span<const ControlPoint> points, ViewPosition reference_view)
      : points_(points), reference_view_(reference_view) {}

  int span_count() const { return points_.size() < 2 ? 0 : static_cast<int>(points_.size()) + 1; }

  /// The i-th point of the clamped sequence; span s has the controls s … s + 3.
  SpatialPoint control(int i) const {
    const int last = static_cast<int>(points_.size()) - 1;
    const ControlPoint& point = points_[static_cast<std::size_t>(std::clamp(i - 2, 0, last))];
    return {x_in_view(point, reference_view_, central_view), point.y, point.disparity};
  }

 private:
  std::span<const ControlPoint> points_;
  ViewPosition reference_view_;
};

/// The curve's point at 0 ≤ t ≤ 1 of one of the spans of a spline, whose control(i) is as a ClampedSpline's.
template <class Spline>
SpatialPoint point_on(const Spline& spline, int span, float t) {
  const SpatialPoint a = spline.control(span), b = spline.control(span + 1), c = spline.control(span + 2),
                     d = spline.control(span + 3);
  const float s = 1 - t;
  const float wa = s * s * s / 6, wb = (3 * t * t * t - 6 * t * t + 4) / 6;
  const float wd = t * t * t / 6, wc = 1 - wa - wb - wd;
  return {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y,
          wa * a.disparity + wb * b.disparity + wc * c.disparity + wd * d.disparity};
}

}  // namespace wheatstone
