#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "wheatstone/marks/residual.h"
#include "wheatstone/strokes/dual_stroke_internal.h"

namespace wheatstone {
namespace {

/// The unit vector across the spline through the points: at an end, across its last side.
Direction normal_at(std::span<const ControlPoint> points, std::size_t i) {
  const ControlPoint& before = points[i == 0 ? 0 : i - 1];
  const ControlPoint& after = points[std::min(i + 1, points.size() - 1)];
  const float dx = after.x - before.x, dy = after.y - before.y, length = std::hypot(dx, dy);
  if (length <= 0) return {0, 0};
  return {-dy / length, dx / length};
}

/// A point beside the stroke, on the stroke's own surface, within the picture.
ControlPoint beside(const LayerPlan& plan, const ControlPoint& point, Direction across, float offset_px) {
  constexpr float rim_px = 0.01f;
  const auto inside = [](float place, int size) { return std::clamp(place, 0.f, static_cast<float>(size) - rim_px); };
  ControlPoint moved{inside(point.x + offset_px * across.x, plan.view.disparity.width()),
                     inside(point.y + offset_px * across.y, plan.view.disparity.height()), point.disparity};
  const float there = plan.view.disparity(static_cast<int>(moved.x), static_cast<int>(moved.y));
  if (std::abs(there - point.disparity) <= plan.depth_threshold_px) moved.disparity = there;
  return moved;
}

Rgb8 colour_at(const ReferencePicture& reference, const ControlPoint& point) {
  const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
  return {reference.red(x, y), reference.green(x, y), reference.blue(x, y)};
}

Rgb8 mean_colour(const ReferencePicture& reference, std::span<const ControlPoint> points) {
  int red = 0, green = 0, blue = 0;
  for (const ControlPoint& point : points) {
    const Rgb8 colour = colour_at(reference, point);
    red += colour.r;
    green += colour.g;
    blue += colour.b;
  }
  const auto count = static_cast<int>(points.size());
  const auto level = [&](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {level(red), level(green), level(blue)};
}

/// Adds strokes along the layer's last points, from `first` on: mostly one, more where its colour would be unlike that
/// of one of its own places.
void add_strokes(const ReferencePicture& reference, std::size_t first, Stroke stroke, Layer& layer) {
  while (first < layer.points.size()) {
    std::span<const ControlPoint> points = std::span(layer.points).subspan(first);
    const auto suits_all = [&] {
      stroke.colour = mean_colour(reference, points);
      return std::ranges::all_of(
          points, [&](const ControlPoint& point) { return is_like(colour_at(reference, point), stroke.colour); });
    };
    while (!suits_all()) points = points.first(points.size() - 1);
    stroke.first_point = static_cast<std::uint32_t>(first);
    stroke.point_count = static_cast<std::uint32_t>(points.size());
    layer.strokes.push_back(stroke);
    stroke.is_part = true;
    first += points.size();
  }
}

}  // namespace

void make_dual(const LayerPlan& plan, Layer& layer) {
  const Stroke whole = layer.strokes.back();
  if (whole.point_count < 2) return;
  const auto points_begin = layer.points.begin() + static_cast<std::ptrdiff_t>(whole.first_point);
  const std::vector<ControlPoint> points(points_begin, layer.points.end());
  layer.points.erase(points_begin, layer.points.end());
  layer.strokes.pop_back();
  const float offset_px = whole.radius_px / 2;
  for (const float side : {-offset_px, offset_px}) {
    Stroke half = whole;
    half.is_part = side > 0;
    // The soft rims of the two overlap, so that nothing shows through between them.
    constexpr float half_rim_px = 0.5f, middle_of_rim = 0.95f;
    half.radius_px = std::min((offset_px + half_rim_px) / middle_of_rim, whole.radius_px);
    const std::size_t first = layer.points.size();
    for (std::size_t i = 0; i < points.size(); ++i)
      layer.points.push_back(beside(plan, points[i], normal_at(points, i), side));
    add_strokes(*plan.reference, first, half, layer);
  }
}

}  // namespace wheatstone
