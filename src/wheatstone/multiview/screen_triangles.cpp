#include "wheatstone/multiview/screen_triangles_internal.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace wheatstone {
namespace {

using PlaceInCamera = std::array<double, 3>;

/// Farther beside the middle of the views, in pixels, triangles are cut off: coordinates stay exact in float.
constexpr double guard_px = 24000;

double rounded(double px) { return std::round(256 * px) / 256; }

/// A corner of a polygon in the camera's coordinates (right, down, forward), and in shares of its triangle's corners.
struct PolygonCorner {
  PlaceInCamera place, share;
};

using Polygon = std::vector<PolygonCorner>;

double along(const PlaceInCamera& a, const std::array<float, 3>& b) {
  return a[0] * static_cast<double>(b[0]) + a[1] * static_cast<double>(b[1]) + a[2] * static_cast<double>(b[2]);
}

/// The parts of a convex polygon where a linear function of the place is at least 0, and where it is at most 0. A point
/// between two corners is computed from the inner one to the outer one, whichever comes first: the same for both
/// triangles at an edge.
template <class Value>
void cut(const Polygon& polygon, Value value, Polygon& inner, Polygon& outer) {
  inner.clear();
  outer.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PolygonCorner& here = polygon[i];
    const PolygonCorner& next = polygon[(i + 1) % polygon.size()];
    const double value_here = value(here.place), value_next = value(next.place);
    if (value_here >= 0) inner.push_back(here);
    if (value_here <= 0) outer.push_back(here);
    if (!((value_here > 0 && value_next < 0) || (value_here < 0 && value_next > 0))) continue;
    const bool goes_out = value_here > 0;
    const PolygonCorner& from = goes_out ? here : next;
    const PolygonCorner& to = goes_out ? next : here;
    const double from_value = goes_out ? value_here : value_next, to_value = goes_out ? value_next : value_here;
    const double at = from_value / (from_value - to_value);
    PolygonCorner between{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      between.place[axis] = from.place[axis] + at * (to.place[axis] - from.place[axis]);
      between.share[axis] = from.share[axis] + at * (to.share[axis] - from.share[axis]);
    }
    inner.push_back(between);
    outer.push_back(between);
  }
}

class Projector {
 public:
  Projector(const ModelScene& scene, const DepthKnots& knots, const Rig& rig)
      : scene_(scene), camera_(scene.camera), knots_(knots), rig_(rig) {
    const auto [first, last] = std::ranges::minmax(rig.positions);
    first_ = static_cast<double>(first.eye_separations());
    last_ = static_cast<double>(last.eye_separations());
    near_ = std::max(static_cast<double>(camera_.nearest_depth), 1e-30);
    focal_ = static_cast<double>(camera_.focal_px);
    orthographic_ = static_cast<double>(camera_.orthographic_depth);
  }

  PlaceInCamera in_camera(const PlaceInCamera& position) const {
    PlaceInCamera from{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      from[axis] = position[axis] - scene_.origin[axis] - static_cast<double>(camera_.position[axis]);
    return {along(from, camera_.right), along(from, camera_.down), along(from, camera_.forward)};
  }

  /// Adds what the views show of a triangle whose corners are at these places.
  void add(std::uint32_t triangle, const std::array<const PlaceInCamera*, 3>& places, ScreenTriangles& to) {
    bool is_inside = true;
    std::size_t most_segment = 0, least_segment = ~std::size_t{0};
    for (const PlaceInCamera* place : places) {
      const PlaceInCamera& at = *place;
      const double reach = guard_px / focal_ * scale_depth(at[2]);
      is_inside = is_inside && at[2] >= near_ && std::abs(at[0]) <= reach && std::abs(at[1]) <= reach;
      const std::size_t segment = knots_.segment_of(at[2]);
      most_segment = std::max(most_segment, segment);
      least_segment = std::min(least_segment, segment);
    }
    if (is_inside && most_segment == least_segment) {
      put(places, triangle, nullptr, to);
      return;
    }
    polygon_.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      polygon_.push_back({*places[k], {}});
      polygon_.back().share[k] = 1;
    }
    cut_off([&](const PlaceInCamera& at) { return at[2] - near_; });
    for (const std::size_t axis : {0, 1}) {
      for (const double side : {-1., 1.}) {
        cut_off([&](const PlaceInCamera& at) { return guard_px / focal_ * scale_depth(at[2]) - side * at[axis]; });
      }
    }
    split(triangle, to);
  }

 private:
  /// The depth by which a point is scaled.
  double scale_depth(double depth) const { return orthographic_ > 0 ? orthographic_ : depth; }

  template <class Value>
  void cut_off(Value value) {
    if (polygon_.empty()) return;
    cut(polygon_, value, part_, rest_);
    std::swap(polygon_, part_);
  }

  /// Splits what is left at the knots, from the nearest to the farthest.
  void split(std::uint32_t triangle, ScreenTriangles& to) {
    for (const double knot : knots_.depths()) {
      if (polygon_.empty()) return;
      const auto [nearest, farthest] =
          std::ranges::minmax(polygon_, {}, [](const PolygonCorner& c) { return c.place[2]; });
      if (farthest.place[2] <= knot) break;
      if (nearest.place[2] >= knot) continue;
      cut(
          polygon_, [&](const PlaceInCamera& at) { return knot - at[2]; }, part_, rest_);
      put_fan(part_, triangle, to);
      std::swap(polygon_, rest_);
    }
    put_fan(polygon_, triangle, to);
  }

  void put_fan(const Polygon& polygon, std::uint32_t triangle, ScreenTriangles& to) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      TrianglePart part{};
      const std::array<const PolygonCorner*, 3> corners{polygon.data(), &polygon[i], &polygon[i + 1]};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) part[k][c] = static_cast<float>(corners[k]->share[c]);
      put({&corners[0]->place, &corners[1]->place, &corners[2]->place}, triangle, &part, to);
    }
  }

  void put(const std::array<const PlaceInCamera*, 3>& places, std::uint32_t triangle, const TrianglePart* part,
           ScreenTriangles& to) {
    ScreenTriangle screen{};
    std::array<std::uint8_t, 3> order{0, 1, 2};
    PlaceInCamera x{}, y{}, disparity{};
    for (std::size_t k = 0; k < 3; ++k) {
      const PlaceInCamera& at = *places[k];
      const double scale = focal_ / scale_depth(at[2]);
      x[k] = rounded(static_cast<double>(camera_.centre_x_px) + scale * at[0]);
      y[k] = rounded(static_cast<double>(camera_.centre_y_px) + scale * at[1]);
      disparity[k] = rounded(knots_.disparity(at[2]));
    }
    if (!is_seen(x, y, disparity)) return;
    std::ranges::sort(order, {}, [&](std::uint8_t k) { return std::array{y[k], x[k], disparity[k]}; });
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = order[k];
      screen.x[k] = static_cast<float>(x[from]);
      screen.y[k] = static_cast<float>(y[from]);
      screen.disparity[k] = static_cast<float>(disparity[from]);
      screen.depth[k] = static_cast<float>((*places[from])[2]);
    }
    screen.triangle = triangle;
    screen.corner = order;
    screen.part = -1;
    if (part != nullptr) {
      screen.part = static_cast<std::int32_t>(to.parts.size());
      to.parts.push_back({(*part)[order[0]], (*part)[order[1]], (*part)[order[2]]});
    }
    to.triangles.push_back(screen);
  }

  /// Whether there are samples of a view between its corners.
  bool is_seen(const PlaceInCamera& x, const PlaceInCamera& y, const PlaceInCamera& disparity) const {
    const auto [top, bottom] = std::ranges::minmax(y);
    const double lines = scene_.look.samples;  // of samples, a pixel
    if (std::ceil(lines * top - 0.5) >= std::ceil(lines * bottom - 0.5)) return false;
    if (bottom <= 0 || top >= rig_.height) return false;
    double left = x[0], right = x[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const double at_first = x[k] - first_ * disparity[k], at_last = x[k] - last_ * disparity[k];
      left = std::min({left, at_first, at_last});
      right = std::max({right, at_first, at_last});
    }
    return right > 0 && left < rig_.width;
  }

  const ModelScene& scene_;
  const Camera& camera_;
  const DepthKnots& knots_;
  const Rig& rig_;
  double first_ = 0, last_ = 0, near_ = 0, focal_ = 1, orthographic_ = 0;
  Polygon polygon_, rest_, part_;
};

/// Puts the triangles of several together, in their order.
ScreenTriangles joined(std::span<const ScreenTriangles> pieces) {
  std::vector<std::size_t> first{0}, first_part{0};
  for (const ScreenTriangles& piece : pieces) {
    first.push_back(first.back() + piece.triangles.size());
    first_part.push_back(first_part.back() + piece.parts.size());
  }
  ScreenTriangles all;
  all.triangles.resize(first.back());
  all.parts.resize(first_part.back());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
    std::ranges::copy(pieces[i].parts, all.parts.begin() + static_cast<std::ptrdiff_t>(first_part[i]));
    auto to = all.triangles.begin() + static_cast<std::ptrdiff_t>(first[i]);
    for (ScreenTriangle triangle : pieces[i].triangles) {
      if (triangle.part >= 0) triangle.part += static_cast<std::int32_t>(first_part[i]);
      *to++ = triangle;
    }
  });
  return all;
}

}  // namespace

ScreenTriangles screen_triangles(const Model& model, const ModelScene& scene, const DepthKnots& knots, const Rig& rig) {
  std::vector<PlaceInCamera> places(model.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 4096), [&](const auto& range) {
    const Projector projector(scene, knots, rig);
    for (std::size_t v = range.begin(); v < range.end(); ++v) places[v] = projector.in_camera(model.positions[v]);
  });
  constexpr std::size_t chunk = 8192;
  std::vector<ScreenTriangles> pieces((model.triangles.size() + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t piece) {
    Projector projector(scene, knots, rig);
    const std::size_t end = std::min((piece + 1) * chunk, model.triangles.size());
    pieces[piece].triangles.reserve(end - piece * chunk);
    for (std::size_t t = piece * chunk; t < end; ++t) {
      const auto& [a, b, c] = model.triangles[t];
      projector.add(static_cast<std::uint32_t>(t), {&places[a], &places[b], &places[c]}, pieces[piece]);
    }
  });
  return joined(pieces);
}

}  // namespace wheatstone
