#include "wheatstone/strokes/stroke_measures.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

StrokeMeasures measure_strokes(std::span<const Layer> layers, const StereoGeometry& geometry) {
  StrokeMeasures measures;
  std::size_t visible = 0, paired = 0, in_both = 0, differing = 0;
  for (const Layer& layer : layers) {
    for (const Stroke& stroke : layer.strokes) {
      measures.strokes += stroke.is_part ? 0 : 1;
      const bool both = shows(stroke, left_eye) && shows(stroke, right_eye);
      if (is_visible_to_both(layer, stroke, geometry)) {
        ++visible;
        measures.visible_to_both += stroke.is_part ? 0 : 1;
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
  measures.paired_share = share(paired, visible);
  measures.shape_differs_share = share(differing, in_both);
  return measures;
}

}  // namespace wheatstone
