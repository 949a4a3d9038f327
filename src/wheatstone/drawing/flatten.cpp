#include "wheatstone/drawing/flatten_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

constexpr float tolerance_px = 0.125f;
constexpr int most_segments_a_span = 16;

float squared_second_difference(PlanePoint a, PlanePoint b, PlanePoint c) {
  const float x = a.x - 2 * b.x + c.x, y = a.y - 2 * b.y + c.y;
  return x * x + y * y;
}

/// Segments that a span needs: a cubic leaves its chord by at most an eighth of its largest second difference, and n
/// segments divide that by n².
int segment_count(const ClampedSpline& spline, int span) {
  const PlanePoint a = spline.control(span), b = spline.control(span + 1), c = spline.control(span + 2),
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
  const auto add = [&](PlanePoint p) {
    flat.x[vertex] = p.x;
    flat.y[vertex] = p.y;
    ++vertex;
    stroke.top = std::min(stroke.top, p.y);
    stroke.bottom = std::max(stroke.bottom, p.y);
  };
  const PlanePoint begin = spline.control(0);
  stroke.top = stroke.bottom = begin.y;
  add(begin);
  for (int span = 0; span < spline.span_count(); ++span) {
    const int segments = segment_count(spline, span);
    for (int i = 1; i <= segments; ++i)
      add(point_on(spline, span, static_cast<float>(i) / static_cast<float>(segments)));
  }
}

}  // namespace

FlatLayer flatten(const Layer& layer, ViewPosition view) {
  std::vector<const Stroke*> shown;
  shown.reserve(layer.strokes.size());
  for (const Stroke& stroke : layer.strokes)
    if (stroke.views.contains(view)) shown.push_back(&stroke);

  FlatLayer flat;
  flat.strokes.resize(shown.size());
  const auto spline_of = [&](std::size_t i) {
    return ClampedSpline(layer.points_of(*shown[i]), shown[i]->reference_view, view);
  };
  tbb::parallel_for(std::size_t{0}, shown.size(),
                    [&](std::size_t i) { flat.strokes[i].vertex_count = vertex_count(spline_of(i)); });

  std::uint32_t vertices = 0;
  for (FlatStroke& stroke : flat.strokes) {
    stroke.first_vertex = vertices;
    vertices += stroke.vertex_count;
  }
  flat.x.resize(vertices);
  flat.y.resize(vertices);

  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    FlatStroke& stroke = flat.strokes[i];
    const Stroke& source = *shown[i];
    stroke.radius_px = source.radius_px;
    stroke.opacity = source.opacity;
    stroke.disparity = source.disparity;
    stroke.red = source.colour.r;
    stroke.green = source.colour.g;
    stroke.blue = source.colour.b;
    write_vertices(spline_of(i), stroke, flat);
  });
  return flat;
}

}  // namespace wheatstone
