#include "wheatstone/drawing/flatten_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/marks/spline.h"
#include "wheatstone/random.h"

namespace wheatstone {
namespace {

/// The largest squared second difference at the controls of a span that one segment may replace: a chord leaves its
/// curve by at most an eighth of the second difference, and a segment may leave it by an eighth of the brush's rim.
float squared_bend_of_segment(float radius_px) {
  const float rim_px = BrushProfile(radius_px).rim_px;
  return rim_px * rim_px;
}

/// The controls of one stroke's spline, and the squared second difference at each, in the view where it bends most.
class BendingSpline {
 public:
  void set(const ClampedSpline& spline) {
    spans_ = spline.span_count();
    const auto count = static_cast<std::size_t>(std::max(spans_ + 3, 1));
    if (controls_.size() < count) {
      controls_.resize(count);
      bends_.resize(count);
    }
    for (std::size_t i = 0; i < count; ++i) controls_[i] = spline.control(static_cast<int>(i));
    for (std::size_t i = 1; i + 1 < count; ++i)
      bends_[i] = squared_bend(controls_[i - 1], controls_[i], controls_[i + 1]);
  }

  int span_count() const { return spans_; }
  SpatialPoint control(int i) const { return controls_[static_cast<std::size_t>(i)]; }
  float bend(int control) const { return bends_[static_cast<std::size_t>(control)]; }

 private:
  static float squared_bend(const SpatialPoint& a, const SpatialPoint& b, const SpatialPoint& c) {
    const float depth = std::abs(a.disparity - 2 * b.disparity + c.disparity) * (right_eye - central_view);
    const float x = std::abs(a.x - 2 * b.x + c.x) + depth, y = a.y - 2 * b.y + c.y;
    return x * x + y * y;
  }

  int spans_ = 0;
  std::vector<SpatialPoint> controls_;  ///< and more, of longer ones before
  std::vector<float> bends_;
};

/// Calls `add` with the vertices of a chain that approximates a spline: several segments for a span that bends much, or
/// one segment for several spans. The chord of n spans leaves the curve n² times as far as that of one.
template <class Add>
void visit_vertices(const BendingSpline& spline, float radius_px, Add add) {
  constexpr int most_segments_a_span = 16;
  const float most = squared_bend_of_segment(radius_px);
  add(spline.control(0));
  for (int first = 0, end = 0; first < spline.span_count(); first = end) {
    const float bend = std::max(spline.bend(first + 1), spline.bend(first + 2));
    int segments = 1;
    end = first + 1;
    if (bend > most) {
      segments = std::min(static_cast<int>(std::ceil(std::sqrt(std::sqrt(bend / most)))), most_segments_a_span);
    } else {
      for (float largest = bend; end < spline.span_count(); ++end) {
        largest = std::max(largest, spline.bend(end + 2));
        const auto spans = static_cast<float>(end + 1 - first);
        if (largest * spans * spans * spans * spans > most) break;
      }
    }
    for (int i = 1; i <= segments; ++i)
      add(point_on(spline, end - 1, static_cast<float>(i) / static_cast<float>(segments)));
  }
}

/// `vertices` is scratch memory.
void add_vertices(const BendingSpline& spline, std::vector<SpatialPoint>& vertices, FlatStroke& stroke,
                  FlatLayer& flat) {
  vertices.clear();
  SpatialPoint least = spline.control(0), greatest = least;
  visit_vertices(spline, stroke.radius_px, [&](const SpatialPoint& p) {
    vertices.push_back(p);
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.disparity, p.disparity)};
    greatest = {std::max(greatest.x, p.x), std::max(greatest.y, p.y), std::max(greatest.disparity, p.disparity)};
  });
  const std::size_t first = flat.x.size();
  for (std::vector<float>* values : {&flat.x, &flat.y, &flat.disparity, &flat.along})
    values->resize(first + vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    flat.x[first + i] = vertices[i].x;
    flat.y[first + i] = vertices[i].y;
    flat.disparity[first + i] = vertices[i].disparity;
    if (i > 0) stroke.length += std::hypot(vertices[i].x - vertices[i - 1].x, vertices[i].y - vertices[i - 1].y);
    flat.along[first + i] = stroke.length;
  }
  stroke.first_vertex = static_cast<std::uint32_t>(first);
  stroke.vertex_count = static_cast<std::uint32_t>(vertices.size());
  stroke.top = least.y;
  stroke.bottom = greatest.y;
  stroke.left = least.x;
  stroke.right = greatest.x;
  stroke.farthest_disparity = least.disparity;
  stroke.nearest_disparity = greatest.disparity;
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
  const bool is_long = row_variance > count;  // a stroke of few rows does not determine a slope
  stroke.depth_slope = is_long ? covariance / row_variance : 0;
  stroke.disparity = mean - stroke.depth_slope * mean_row;
  stroke.is_rigid = true;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(disparities[i] - stroke.disparity - stroke.depth_slope * rows[i]) > rigid_px) stroke.is_rigid = false;
}

/// `place`: the stroke's index in its layer.
FlatStroke without_vertices(const Stroke& source, std::size_t place) {
  FlatStroke stroke;
  stroke.radius_px = source.radius_px;
  stroke.opacity = source.opacity;
  stroke.views = source.views;
  stroke.number = source.number;
  stroke.seed = static_cast<std::uint32_t>(hash_keys({source.number != 0 ? source.number : place}));
  stroke.reference_view = source.reference_view;
  const auto& [begin, end] = source.fine;
  const auto colour = [](std::uint8_t level, std::int8_t fine) {
    return static_cast<float>(level) + static_cast<float>(fine) / FineColour::steps_a_level;
  };
  const auto change = [](std::int16_t levels, std::int8_t from, std::int8_t to) {
    return static_cast<float>(levels) + static_cast<float>(to - from) / FineColour::steps_a_level;
  };
  stroke.red = colour(source.colour.r, begin[0]);
  stroke.green = colour(source.colour.g, begin[1]);
  stroke.blue = colour(source.colour.b, begin[2]);
  stroke.red_change = change(source.change.r, begin[0], end[0]);
  stroke.green_change = change(source.change.g, begin[1], end[1]);
  stroke.blue_change = change(source.change.b, begin[2], end[2]);
  return stroke;
}

HWY_INLINE void ask_for_points(const Layer& layer, const Stroke& stroke) {
  const ControlPoint* const points = &layer.points[stroke.first_point];
  hwy::Prefetch(points);
  hwy::Prefetch(points + stroke.point_count / 2);
  hwy::Prefetch(points + stroke.point_count);
}

/// Some neighbouring strokes of a layer.
FlatLayer flatten(const Layer& layer, std::size_t first, std::size_t end) {
  FlatLayer part;
  part.strokes.reserve(end - first);
  BendingSpline spline;
  std::vector<SpatialPoint> vertices;
  for (std::size_t i = first; i < end; ++i) {
    // The points of strokes that are neighbours in drawing order lie far apart in memory.
    constexpr std::size_t points_ahead = 6;
    if (i + points_ahead < end) ask_for_points(layer, layer.strokes[i + points_ahead]);
    const Stroke& source = layer.strokes[i];
    FlatStroke& stroke = part.strokes.emplace_back(without_vertices(source, i));
    spline.set(ClampedSpline(layer.points_of(source), source.reference_view));
    add_vertices(spline, vertices, stroke, part);
    fit_depth(part, stroke);
  }
  return part;
}

}  // namespace

FlatLayer flatten(const Layer& layer) {
  constexpr std::size_t strokes_at_once = 512;
  const std::size_t count = layer.strokes.size();
  std::vector<FlatLayer> parts((count + strokes_at_once - 1) / strokes_at_once);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = flatten(layer, i * strokes_at_once, std::min((i + 1) * strokes_at_once, count));
  });
  std::vector<std::uint32_t> first_vertices;
  std::uint32_t vertices = 0;
  for (const FlatLayer& part : parts) {
    first_vertices.push_back(vertices);
    vertices += static_cast<std::uint32_t>(part.x.size());
  }
  FlatLayer flat;
  flat.strokes.resize(count);
  for (std::vector<float>* values : {&flat.x, &flat.y, &flat.disparity, &flat.along})
    values->resize(vertices + FlatLayer::values_after);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    FlatLayer& part = parts[i];
    for (FlatStroke& stroke : part.strokes) stroke.first_vertex += first_vertices[i];
    const auto to = static_cast<std::ptrdiff_t>(first_vertices[i]);
    std::ranges::copy(part.strokes, flat.strokes.begin() + static_cast<std::ptrdiff_t>(i * strokes_at_once));
    std::ranges::copy(part.x, flat.x.begin() + to);
    std::ranges::copy(part.y, flat.y.begin() + to);
    std::ranges::copy(part.disparity, flat.disparity.begin() + to);
    std::ranges::copy(part.along, flat.along.begin() + to);
  });
  return flat;
}

}  // namespace wheatstone
