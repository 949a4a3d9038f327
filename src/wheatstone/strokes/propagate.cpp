#include "wheatstone/strokes/propagate.h"

#include <algorithm>

namespace wheatstone {
namespace {

float median(float a, float b, float c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

/// Single wrong disparities would bend the stroke in the other eye: each becomes the median of itself and its
/// neighbours on the stroke (Bukenberger et al. 2015, sec. 3).
void smooth_disparities(std::span<const ControlPoint> points, std::span<ControlPoint> smoothed) {
  std::ranges::copy(points, smoothed.begin());
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    smoothed[i].disparity = median(points[i - 1].disparity, points[i].disparity, points[i + 1].disparity);
}

bool is_occluded(const ControlPoint& point, const ImageView<const std::uint8_t>& occlusion) {
  return occlusion(static_cast<int>(point.x), static_cast<int>(point.y)) != 0;
}

}  // namespace

Layer propagate_to_other_eye(const Layer& planned, ImageView<const std::uint8_t> occlusion) {
  Layer split;
  split.radius_px = planned.radius_px;
  split.points.resize(planned.points.size());
  split.strokes.reserve(planned.strokes.size());
  for (const Stroke& stroke : planned.strokes) {
    const std::span points = std::span(split.points).subspan(stroke.first_point, stroke.point_count);
    smooth_disparities(planned.points_of(stroke), points);
    for (std::uint32_t begin = 0; begin < points.size();) {
      const bool occluded = is_occluded(points[begin], occlusion);
      std::uint32_t end = begin + 1;
      while (end < points.size() && is_occluded(points[end], occlusion) == occluded) ++end;
      Stroke part = stroke;
      part.first_point = stroke.first_point + begin;
      part.point_count = end - begin;
      part.disparity = points[begin].disparity;
      part.views = occluded ? ViewRange{stroke.reference_view, stroke.reference_view} : ViewRange{};
      split.strokes.push_back(part);
      begin = end;
    }
  }
  return split;
}

}  // namespace wheatstone
