#include "wheatstone/drawing/flatten_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

/// The square of how far a spline may bend at the controls of a span that one segment stands for: a chord leaves its
/// curve by at most an eighth of the second difference, and a segment may by an eighth of the brush's rim.
float squared_bend_of_segment(float radius_px) {
  const float rim_px = BrushProfile(radius_px).rim_px;
  return rim_px * rim_px;
}

/// The squared second difference of a spline at one of its controls, in the view where it bends most.
float squared_bend(const ClampedSpline& spline, int control) {
  const SpatialPoint a = spline.control(control - 1), b = spline.control(control), c = spline.control(control + 1);
  const float depth = std::abs(a.disparity - 2 * b.disparity + c.disparity) * (right_eye - central_view);
  const float x = std::abs(a.x - 2 * b.x + c.x) + depth, y = a.y - 2 * b.y + c.y;
  return x * x + y * y;
}

/// Calls `add` with the vertices of a chain that stands for a spline: some segments for a span that bends much, or one
/// for some spans. The chord of n spans leaves the curve n² times as far as that of one.
template <class Add>
void visit_vertices(const ClampedSpline& spline, float radius_px, Add add) {
  constexpr int most_segments_a_span = 16;
  const float most = squared_bend_of_segment(radius_px);
  add(spline.control(0));
  for (int first = 0, end = 0; first < spline.span_count(); first = end) {
    const float bend = std::max(squared_bend(spline, first + 1), squared_bend(spline, first + 2));
    int segments = 1;
    end = first + 1;
    if (bend > most) {
      segments = std::min(static_cast<int>(std::ceil(std::sqrt(std::sqrt(bend / most)))), most_segments_a_span);
    } else {
      for (float largest = bend; end < spline.span_count(); ++end) {
        largest = std::max(largest, squared_bend(spline, end + 2));
        const auto spans = static_cast<float>(end + 1 - first);
        if (largest * spans * spans * spans * spans > most) break;
      }
    }
    for (int i = 1; i <= segments; ++i)
      add(point_on(spline, end - 1, static_cast<float>(i) / static_cast<float>(segments)));
  }
}

void write_vertices(const ClampedSpline& spline, FlatStroke& stroke, FlatLayer& flat) {
  std::size_t vertex = stroke.first_vertex;
  const SpatialPoint begin = spline.control(0);
  stroke.top = stroke.bottom = begin.y;
  stroke.left = stroke.right = begin.x;
  stroke.farthest_disparity = stroke.nearest_disparity = begin.disparity;
  visit_vertices(spline, stroke.radius_px, [&](const SpatialPoint& p) {
    flat.x[vertex] = p.x;
    flat.y[vertex] = p.y;
    flat.disparity[vertex] = p.disparity;
    ++vertex;
    stroke.top = std::min(stroke.top, p.y);
    stroke.bottom = std::max(stroke.bottom, p.y);
    stroke.left = std::min(stroke.left, p.x);
    stroke.right = std::max(stroke.right, p.x);
    stroke.farthest_disparity = std::min(stroke.farthest_disparity, p.disparity);
    stroke.nearest_disparity = std::max(stroke.nearest_disparity, p.disparity);
  });
}

/// Fits a plane that slopes along the columns to a stroke's disparities.
void fit_depth(const FlatLayer& flat, FlatStroke& stroke) {
  constexpr float rigid_px = 0.5f;
  const auto disparities = std::span(flat.disparity).subspan(stroke.first_vertex, stroke.vertex_count);
  const auto rows = std::span(flat.y).subspan(stroke.first_vertex, stroke.vertex_count);
  const auto count = static_cast<float>(stroke.vertex_count);
  float mean_row = 0, mean = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    mean_row += rows[i] / count;
    mean += disparities[i] / count;
  }
  float row_variance = 0, covariance = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    row_variance += (rows[i] - mean_row) * (rows[i] - mean_row);
    covariance += (rows[i] - mean_row) * (disparities[i] - mean);
  }
  const bool is_long = row_variance > count;  // the rows of a stroke that is not do not tell a slope
  stroke.depth_slope = is_long ? covariance / row_variance : 0;
  stroke.disparity = mean - stroke.depth_slope * mean_row;
  stroke.is_rigid = true;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(disparities[i] - stroke.disparity - stroke.depth_slope * rows[i]) > rigid_px) stroke.is_rigid = false;
}

}  // namespace

FlatLayer flatten(const Layer& layer) {
  const std::size_t count = layer.strokes.size();
  FlatLayer flat;
  flat.strokes.resize(count);
  const auto spline_of = [&](std::size_t i) {
    return ClampedSpline(layer.points_of(layer.strokes[i]), layer.strokes[i].reference_view);
  };
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    std::uint32_t vertices = 0;
    visit_vertices(spline_of(i), layer.strokes[i].radius_px, [&](const SpatialPoint&) { ++vertices; });
    flat.strokes[i].vertex_count = vertices;
  });

  std::uint32_t vertices = 0;
  for (FlatStroke& stroke : flat.strokes) {
    stroke.first_vertex = vertices;
    vertices += stroke.vertex_count;
  }
  for (std::vector<float>* values : {&flat.x, &flat.y, &flat.disparity})
    values->resize(vertices + FlatLayer::values_after);

  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    FlatStroke& stroke = flat.strokes[i];
    const Stroke& source = layer.strokes[i];
    stroke.radius_px = source.radius_px;
    stroke.opacity = source.opacity;
    stroke.views = source.views;
    stroke.number = source.number;
    stroke.reference_view = source.reference_view;
    stroke.red = source.colour.r;
    stroke.green = source.colour.g;
    stroke.blue = source.colour.b;
    write_vertices(spline_of(i), stroke, flat);
    fit_depth(flat, stroke);
  });
  return flat;
}

}  // namespace wheatstone
