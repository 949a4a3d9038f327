#pragma once

#include <cmath>

#include "wheatstone/marks/spline.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/strokes/depth_edges_internal.h"

namespace wheatstone {

/// A view's disparities and how far its pixels are from depth edges.
struct ViewSurfaces {
  const Image<float>& disparity;
  KnownRuns edge_distance;
  float threshold_px;
};

inline bool is_far_from_edge(const ViewSurfaces& surfaces, float x, float y, float radius_px) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  return surfaces.edge_distance.contains(column, row) && !(surfaces.edge_distance(column, row) <= radius_px);
}

/// True where a stroke jumps from one surface to another and is planned on there; a second jump takes it home.
inline bool jumps(const Layer& layer, const Stroke& stroke, const ViewSurfaces& surfaces) {
  const auto points = layer.points_of(stroke);
  bool away = false;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (std::abs(points[i].disparity - points[i - 1].disparity) > surfaces.threshold_px) away = !away;
    if (away && is_far_from_edge(surfaces, points[i].x, points[i].y, stroke.radius_px)) return true;
  }
  return false;
}

/// True where the centre line, walked by steps of a sixth of a radius, lies on a surface whose disparity is not the
/// stroke's own there.
inline bool strays(const Layer& layer, const Stroke& stroke, const ViewSurfaces& surfaces) {
  const ClampedSpline spline(layer.points_of(stroke), stroke.reference_view);
  constexpr int steps = 6;
  for (int span = 0; span < spline.span_count(); ++span) {
    for (int step = 0; step < steps; ++step) {
      const float t = static_cast<float>(step) / steps;
      const SpatialPoint point = point_on(spline, span, t);
      const PlanePoint at = seen_from(point, stroke.reference_view);
      const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
      if (!surfaces.disparity.contains(x, y)) continue;
      const bool away = std::abs(surfaces.disparity(x, y) - point.disparity) > surfaces.threshold_px;
      if (away && is_far_from_edge(surfaces, at.x, at.y, stroke.radius_px)) return true;
    }
  }
  return false;
}

/// How much paint of one layer runs over depth edges, in the views in which its strokes were planned: the share of its
/// strokes, of those that these views show, 0..1, that jump from one surface to another, by more than `threshold_px` of
/// disparity, or whose centre line strays onto another surface, and that come farther away from the edge there than
/// their radius.
inline double spilling_share(const Layer& layer, const StereoGeometry& geometry, float threshold_px) {
  std::size_t spilling = 0, planned = 0;
  for (const ViewPosition view : {left_eye, right_eye}) {
    const Image<float>& disparity = view < central_view ? geometry.left_disparity : geometry.right_disparity;
    const ViewSurfaces surfaces{
        disparity, distance_to_depth_edge(disparity_in_steps(disparity), threshold_px, 2 * layer.radius_px + 2),
        threshold_px};
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.reference_view != view || !stroke.views.contains(view)) continue;
      ++planned;
      spilling += jumps(layer, stroke, surfaces) || strays(layer, stroke, surfaces) ? 1 : 0;
    }
  }
  return planned == 0 ? 0 : static_cast<double>(spilling) / static_cast<double>(planned);
}

}  // namespace wheatstone
