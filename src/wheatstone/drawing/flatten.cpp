#include "wheatstone/drawing/flatten_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

constexpr float tolerance_px = 0.125f;
constexpr int most_segments_a_span = 16;

/// By how far three controls of a spline bend, in the view where they bend most.
float squared_second_difference(const SpatialPoint& a, const SpatialPoint& b, const SpatialPoint& c) {
  const float depth = std::abs(a.disparity - 2 * b.disparity + c.disparity) * (right_eye - central_view);
  const float x = std::abs(a.x - 2 * b.x + c.x) + depth, y = a.y - 2 * b.y + c.y;
  return x * x + y * y;
}

/// Segments that a span needs: a cubic leaves its chord by at most an eighth of its largest second difference, and n
/// segments divide that by n².
int segment_count(const ClampedSpline& spline, int span) {
  const SpatialPoint a = spline.control(span), b = spline.control(span + 1), c = spline.control(span + 2),
                     d = spline.control(span + 3);
  const float squared = std::max(squared_second_difference(a, b, c), squared_second_difference(b, c, d));
  constexpr float enough_for_one = 8 * tolerance_px;
  if (squared <= enough_for_one * enough_for_one) return 1;
  return std::min(static_cast<int>(std::ceil(std::sqrt(std::sqrt(squared) / enough_for_one))), most_segments_a_span);
}

std::uint32_t vertex_count(const ClampedSpline& spline) {
  int count = 1;
  for (int span = 0; span < spline.span_count(); ++span) count += segment_count(spline, span);
  return static_cast<std::uint32_t>(count);
}

void write_vertices(const ClampedSpline& spline, FlatStroke& stroke, FlatLayer& flat) {
  std::size_t vertex = stroke.first_vertex;
  const auto add = [&](const SpatialPoint& p) {
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
  };
  const SpatialPoint begin = spline.control(0);
  stroke.top = stroke.bottom = begin.y;
  stroke.left = stroke.right = begin.x;
  stroke.farthest_disparity = stroke.nearest_disparity = begin.disparity;
  add(begin);
  for (int span = 0; span < spline.span_count(); ++span) {
    const int segments = segment_count(spline, span);
    for (int i = 1; i <= segments; ++i)
      add(point_on(spline, span, static_cast<float>(i) / static_cast<float>(segments)));
  }
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
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { flat.strokes[i].vertex_count = vertex_count(spline_of(i)); });

  std::uint32_t vertices = 0;
  for (FlatStroke& stroke : flat.strokes) {
    stroke.first_vertex = vertices;
    vertices += stroke.vertex_count;
  }
  flat.x.resize(vertices);
  flat.y.resize(vertices);
  flat.disparity.resize(vertices);

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
