#include "wheatstone/painting/stroke_measures.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/painting/flatten.h"

namespace wheatstone {
namespace {

bool shows(const Stroke& stroke, float view) { return stroke.views.contains(view); }

bool is_visible_to_both(const Layer& layer, const Stroke& stroke, const StereoGeometry& geometry) {
  const Image<std::uint8_t>& occlusion = stroke.reference_view < 0 ? geometry.left_occlusion : geometry.right_occlusion;
  return std::ranges::none_of(layer.points_of(stroke), [&](const ControlPoint& point) {
    const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
    return occlusion.contains(x, y) && occlusion(x, y) != 0;
  });
}

float length_in(const Layer& layer, const Stroke& stroke, float view) {
  const auto points = layer.points_of(stroke);
  float length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(x_in_view(points[i], stroke.reference_view, view) -
                             x_in_view(points[i - 1], stroke.reference_view, view),
                         points[i].y - points[i - 1].y);
  return length;
}

bool shape_differs(const Layer& layer, const Stroke& stroke) {
  const float left = length_in(layer, stroke, left_eye), right = length_in(layer, stroke, right_eye);
  const float difference = std::abs(left - right);
  constexpr float least_px = 1, least_ratio = 0.1f;
  return difference > least_px && difference > least_ratio * std::max(left, right);
}

/// Walks one flattened centre line pixel by pixel and measures how far it goes on after leaving its first surface.
bool spills(const FlatLayer& flat, const FlatStroke& stroke, const Image<float>& disparity, float threshold_px) {
  float last = NAN, beyond_px = 0;
  bool crossed = false;
  for (std::uint32_t i = 0; i + 1 < stroke.vertex_count; ++i) {
    const std::size_t from = stroke.first_vertex + i, to = from + 1;
    const float dx = flat.x[to] - flat.x[from], dy = flat.y[to] - flat.y[from];
    const int steps = std::max(static_cast<int>(std::ceil(2 * std::hypot(dx, dy))), 1);
    for (int step = 0; step < steps; ++step) {
      const float t = static_cast<float>(step) / static_cast<float>(steps);
      const int x = static_cast<int>(flat.x[from] + t * dx), y = static_cast<int>(flat.y[from] + t * dy);
      if (!disparity.contains(x, y)) continue;
      if (!std::isnan(last) && std::abs(disparity(x, y) - last) > threshold_px) crossed = true;
      if (crossed) beyond_px += std::hypot(dx, dy) / static_cast<float>(steps);
      last = disparity(x, y);
    }
  }
  return beyond_px > stroke.radius_px;
}

}  // namespace

StrokeMeasures measure_strokes(const Painting& painting, const StereoGeometry& geometry) {
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
  for (const float view : {left_eye, right_eye}) {
    Layer own = layer;
    std::erase_if(own.strokes, [&](const Stroke& stroke) { return stroke.reference_view != view; });
    const FlatLayer flat = flatten(own, view);
    const Image<float>& disparity = view < 0 ? geometry.left_disparity : geometry.right_disparity;
    planned += flat.strokes.size();
    spilling += std::ranges::count_if(
        flat.strokes, [&](const FlatStroke& stroke) { return spills(flat, stroke, disparity, threshold_px); });
  }
  return planned == 0 ? 0 : static_cast<double>(spilling) / static_cast<double>(planned);
}

}  // namespace wheatstone
