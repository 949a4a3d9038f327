#include "wheatstone/strokes/stroke_measures.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/marks/spline.h"
#include "wheatstone/strokes/depth_edges_internal.h"

namespace wheatstone {
namespace {

bool shows(const Stroke& stroke, ViewPosition view) { return stroke.views.contains(view); }

bool is_visible_to_both(const Layer& layer, const Stroke& stroke, const StereoGeometry& geometry) {
  const Image<std::uint8_t>& occlusion =
      stroke.reference_view < central_view ? geometry.left_occlusion : geometry.right_occlusion;
  return std::ranges::none_of(layer.points_of(stroke), [&](const ControlPoint& point) {
    const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
    return occlusion.contains(x, y) && occlusion(x, y) != 0;
  });
}

float length_in(const Layer& layer, const Stroke& stroke, ViewPosition view) {
  const auto points = layer.points_of(stroke);
  float length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(
        x_in_view(points[i], stroke.reference_view, view) - x_in_view(points[i - 1], stroke.reference_view, view),
        points[i].y - points[i - 1].y);
  return length;
}

bool shape_differs(const Layer& layer, const Stroke& stroke) {
  const float left = length_in(layer, stroke, left_eye), right = length_in(layer, stroke, right_eye);
  const float difference = std::abs(left - right);
  constexpr float least_px = 1, least_ratio = 0.1f;
  return difference > least_px && difference > least_ratio * std::max(left, right);
}

/// A view's disparities and how far its pixels are from depth edges.
struct Surfaces {
  const Image<float>& disparity;
  Image<float> edge_distance;
  float threshold_px;
};

bool is_far_from_edge(const Surfaces& surfaces, float x, float y, float radius_px) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  return surfaces.edge_distance.contains(column, row) && surfaces.edge_distance(column, row) > radius_px;
}

/// True where a stroke jumps from one surface to another and is planned on there; a second jump takes it home.
bool jumps(const Layer& layer, const Stroke& stroke, const Surfaces& surfaces) {
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
bool strays(const Layer& layer, const Stroke& stroke, const Surfaces& surfaces) {
  const ClampedSpline left(layer.points_of(stroke), stroke.reference_view, left_eye);
  const ClampedSpline right(layer.points_of(stroke), stroke.reference_view, right_eye);
  const ClampedSpline& own = stroke.reference_view < central_view ? left : right;
  constexpr int steps = 6;
  for (int span = 0; span < own.span_count(); ++span) {
    for (int step = 0; step < steps; ++step) {
      const float t = static_cast<float>(step) / steps;
      const PlanePoint at = point_on(own, span, t);
      const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
      if (!surfaces.disparity.contains(x, y)) continue;
      const float disparity = point_on(left, span, t).x - point_on(right, span, t).x;
      const bool away = std::abs(surfaces.disparity(x, y) - disparity) > surfaces.threshold_px;
      if (away && is_far_from_edge(surfaces, at.x, at.y, stroke.radius_px)) return true;
    }
  }
  return false;
}

}  // namespace

StrokeMeasures measure_strokes(const StrokePainting& painting, const StereoGeometry& geometry) {
  StrokeMeasures measures;
  std::size_t paired = 0, in_both = 0, differing = 0;
  for (const Layer& layer : painting.layers) {
    for (const Stroke& stroke : layer.strokes) {
      ++measures.strokes;
      const bool both = shows(stroke, left_eye) && shows(stroke, right_eye);
      if (is_visible_to_both(layer, stroke, geometry)) {
        ++measures.visible_to_both;
        paired += both ? 1 : 0;
      }
      if (!both) continue;
      ++in_both;
      differing += shape_differs(layer, stroke) ? 1 : 0;
    }
  }
  const auto share = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  measures.paired_share = share(paired, measures.visible_to_both);
  measures.shape_differs_share = share(differing, in_both);
  return measures;
}

double spilling_share(const Layer& layer, const StereoGeometry& geometry, float threshold_px) {
  std::size_t spilling = 0, planned = 0;
  for (const ViewPosition view : {left_eye, right_eye}) {
    const Image<float>& disparity = view < central_view ? geometry.left_disparity : geometry.right_disparity;
    const Surfaces surfaces{disparity, distance_to_depth_edge(disparity, threshold_px, 2 * layer.radius_px + 2),
                            threshold_px};
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.reference_view != view) continue;
      ++planned;
      spilling += jumps(layer, stroke, surfaces) || strays(layer, stroke, surfaces) ? 1 : 0;
    }
  }
  return planned == 0 ? 0 : static_cast<double>(spilling) / static_cast<double>(planned);
}

}  // namespace wheatstone
