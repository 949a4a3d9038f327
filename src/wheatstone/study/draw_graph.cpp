#include "wheatstone/study/draw_graph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

using Vector = std::array<float, 3>;
using Light = std::array<float, 3>;  // linear

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator*(float f, const Vector& a) { return {f * a[0], f * a[1], f * a[2]}; }
float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit(const Vector& a) { return 1 / std::sqrt(dot(a, a)) * a; }

Light linear(Rgb8 colour) {
  return {linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)};
}

/// A sphere, or a tube around an axis.
struct Shape {
  bool is_sphere;
  Vector from_eye;      ///< to the sphere's middle or the tube's beginning
  Vector axis{};        ///< of length 1, from the tube's beginning to its end
  float length = 0;     ///< of the axis
  Vector beside_eye{};  ///< from the axis, at a right angle, to the eye
  float radius;
  Light colour;
  // On the screen, in pixels:
  std::array<float, 2> begin_px, end_px;
  float margin_px;  ///< how far it reaches beside the line between its ends
};

/// What a pixel's line of sight meets.
struct Fragment {
  float depth;
  float coverage;
  Light light;
};

/// Where a line of sight meets a shape: how far along it, the share of the pixel, the surface's direction.
struct Hit {
  float along = 0;
  float coverage = 0;
  Vector normal{};
};

/// A line of sight.
struct Sight {
  Vector direction;  ///< of length 1
  float pixel;       ///< width of a pixel at a distance of 1
};

/// Share of a pixel that is covered where the line of sight passes `miss` from the middle of something round.
float coverage_of(float radius, float miss, float pixel_width) {
  return std::clamp(0.5f + (radius - miss) / pixel_width, 0.0f, 1.0f);
}

Hit meet_sphere(const Shape& shape, const Sight& sight) {
  const float middle = dot(shape.from_eye, sight.direction);
  const Vector across = shape.from_eye - middle * sight.direction;
  const float miss_2 = dot(across, across);
  Hit hit;
  hit.coverage = coverage_of(shape.radius, std::sqrt(miss_2), sight.pixel * middle);
  if (hit.coverage <= 0) return hit;
  hit.along = middle - std::sqrt(std::max(0.0f, shape.radius * shape.radius - miss_2));
  hit.normal = unit(hit.along * sight.direction - shape.from_eye);
  return hit;
}

Hit meet_tube(const Shape& shape, const Sight& sight) {
  // The line of sight without its part along the axis.
  const Vector beside = sight.direction - dot(sight.direction, shape.axis) * shape.axis;
  const float speed_2 = dot(beside, beside);
  Hit hit;
  if (speed_2 < 1e-12f) return hit;  // along the axis: the node at its end hides it
  const float nearest = -dot(shape.beside_eye, beside) / speed_2;
  const Vector across = shape.beside_eye + nearest * beside;
  const float miss_2 = dot(across, across);
  hit.coverage = coverage_of(shape.radius, std::sqrt(miss_2), sight.pixel * nearest);
  if (hit.coverage <= 0) return hit;
  hit.along = nearest - std::sqrt(std::max(0.0f, shape.radius * shape.radius - miss_2) / speed_2);
  const float on_axis = dot(hit.along * sight.direction - shape.from_eye, shape.axis);
  if (on_axis < 0 || on_axis > shape.length) return {};  // the ends lie inside nodes
  hit.normal = unit(shape.beside_eye + hit.along * beside);
  return hit;
}

/// Diffuse light from the upper left and in front, and a little from everywhere, more from above.
float brightness(const Vector& normal) {
  static const Vector to_lamp = unit({-0.45f, -0.65f, -0.75f});
  return 0.22f - 0.08f * normal[1] + 0.85f * std::max(0.0f, dot(normal, to_lamp));
}

Shape make_shape(const StudyScreen& screen, const EyePlace& eye, const std::array<PlaceMm, 2>& ends, float radius,
                 const Light& colour) {
  const float nearest = eye.distance_mm + std::min(ends[0][2], ends[1][2]) - radius;
  Shape shape{.is_sphere = ends[0] == ends[1],
              .from_eye = ends[0] - Vector{eye.x_mm, 0, -eye.distance_mm},
              .radius = radius,
              .colour = colour,
              .begin_px = on_screen_px(screen, eye, ends[0]),
              .end_px = on_screen_px(screen, eye, ends[1]),
              // What is seen from the side reaches a little farther than its radius.
              .margin_px = 1.1f * radius * eye.distance_mm / std::max(nearest, 1.0f) / screen.pixel_pitch_mm() + 1.5f};
  if (shape.is_sphere) return shape;
  const Vector axis = ends[1] - ends[0];
  shape.length = std::sqrt(dot(axis, axis));
  shape.axis = unit(axis);
  shape.beside_eye = dot(shape.from_eye, shape.axis) * shape.axis - shape.from_eye;
  return shape;
}

std::vector<Shape> shapes_of(const PathGraph& graph, const StudyScreen& screen, const EyePlace& eye,
                             const GraphLook& look) {
  std::vector<Shape> shapes;
  shapes.reserve(graph.nodes.size() + graph.links.size());
  const auto place = [&graph](int node) { return graph.nodes[static_cast<std::size_t>(node)]; };
  for (const auto& [from, to] : graph.links)
    shapes.push_back(make_shape(screen, eye, {place(from), place(to)}, graph.link_radius_mm, linear(look.link)));
  for (int node = 0; node < std::ssize(graph.nodes); ++node) {
    const bool highlighted = std::ranges::find(graph.highlighted, node) != graph.highlighted.end();
    const Light colour = linear(highlighted ? look.highlighted : look.node);
    shapes.push_back(make_shape(screen, eye, {place(node), place(node)}, graph.node_radius_mm, colour));
  }
  return shapes;
}

/// The columns of a row that a shape may cover.
std::array<int, 2> columns_in_row(const Shape& shape, float y, int width) {
  const auto& [x0, y0] = shape.begin_px;
  const auto& [x1, y1] = shape.end_px;
  const float margin = shape.margin_px;
  if (y < std::min(y0, y1) - margin || y > std::max(y0, y1) + margin) return {0, 0};
  float left = std::min(x0, x1) - margin, right = std::max(x0, x1) + margin;
  // Of the line between its ends, what lies near enough along the row.
  if (const float rise = y1 - y0; std::abs(rise) > 1e-3f) {
    const float middle = x0 + (y - y0) * (x1 - x0) / rise;
    const float reach = margin * std::hypot(x1 - x0, rise) / std::abs(rise);
    left = std::max(left, middle - reach);
    right = std::min(right, middle + reach);
  }
  const auto column = [width](float x) { return std::clamp(static_cast<int>(std::floor(x)), 0, width); };
  return {column(left), column(right + 1)};
}

/// What lies behind each other at the pixels of one row, from near to far. More than `most` shapes one behind the other
/// at one pixel lose the farthest.
class RowOfFragments {
 public:
  explicit RowOfFragments(int width)
      : fragments_(static_cast<std::size_t>(width) * most), counts_(static_cast<std::size_t>(width)) {}

  void clear() { std::ranges::fill(counts_, std::uint8_t{0}); }

  void add(int x, const Fragment& fragment) {
    Fragment* const here = &fragments_[static_cast<std::size_t>(x) * most];
    std::uint8_t& count = counts_[static_cast<std::size_t>(x)];
    if (count == most && here[most - 1].depth <= fragment.depth) return;
    std::size_t place = std::min<std::size_t>(count, most - 1);
    for (; place > 0 && here[place - 1].depth > fragment.depth; --place) here[place] = here[place - 1];
    here[place] = fragment;
    if (count < most) ++count;
  }

  bool is_bare(int x) const { return counts_[static_cast<std::size_t>(x)] == 0; }

  Light light(int x, const Light& background) const {
    const Fragment* const here = &fragments_[static_cast<std::size_t>(x) * most];
    Light sum{};
    float open = 1;
    for (std::size_t i = 0; i < counts_[static_cast<std::size_t>(x)] && open > 0; ++i) {
      for (std::size_t c = 0; c < 3; ++c) sum[c] += open * here[i].coverage * here[i].light[c];
      open *= 1 - here[i].coverage;
    }
    for (std::size_t c = 0; c < 3; ++c) sum[c] += open * background[c];
    return sum;
  }

 private:
  static constexpr std::size_t most = 8;
  std::vector<Fragment> fragments_;
  std::vector<std::uint8_t> counts_;
};

Sight sight_through(const StudyScreen& screen, const EyePlace& eye, int x, int y) {
  const float pitch = screen.pixel_pitch_mm();
  const Vector along{(static_cast<float>(x) + 0.5f - static_cast<float>(screen.width_px) / 2) * pitch - eye.x_mm,
                     (static_cast<float>(y) + 0.5f - static_cast<float>(screen.height_px) / 2) * pitch,
                     eye.distance_mm};
  const float nearness = 1 / std::sqrt(dot(along, along));
  return {nearness * along, pitch * nearness};
}

void draw_row(const std::vector<Shape>& shapes, const StudyScreen& screen, const EyePlace& eye, int y,
              RowOfFragments& row) {
  row.clear();
  for (const Shape& shape : shapes) {
    const auto [begin, end] = columns_in_row(shape, static_cast<float>(y) + 0.5f, screen.width_px);
    for (int x = begin; x < end; ++x) {
      const Sight sight = sight_through(screen, eye, x, y);
      const Hit hit = shape.is_sphere ? meet_sphere(shape, sight) : meet_tube(shape, sight);
      if (hit.coverage > 0) row.add(x, {hit.along, hit.coverage, brightness(hit.normal) * shape.colour});
    }
  }
}

}  // namespace

Image<Rgb8> draw_graph(const PathGraph& graph, const StudyScreen& screen, const EyePlace& eye, const GraphLook& look) {
  const std::vector<Shape> shapes = shapes_of(graph, screen, eye, look);
  const Light background = linear(look.background);
  Image<Rgb8> picture(screen.width_px, screen.height_px, look.background);
  constexpr int rows_a_task = 16;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, screen.height_px, rows_a_task), [&](const tbb::blocked_range<int>& rows) {
        RowOfFragments row(screen.width_px);
        for (int y = rows.begin(); y < rows.end(); ++y) {
          draw_row(shapes, screen, eye, y, row);
          for (int x = 0; x < screen.width_px; ++x) {
            if (row.is_bare(x)) continue;
            const Light light = row.light(x, background);
            picture(x, y) = {srgb_from_linear(light[0]), srgb_from_linear(light[1]), srgb_from_linear(light[2])};
          }
        }
      });
  return picture;
}

Image<Rgb8> with_crosstalk(const Image<Rgb8>& own, const std::array<Image<Rgb8>, 2>& beside, float share) {
  Image<Rgb8> mixed(own.width(), own.height());
  const auto mix = [share](std::uint8_t mine, std::uint8_t a, std::uint8_t b) {
    return srgb_from_linear((1 - share) * linear_from_srgb(mine) +
                            share / 2 * (linear_from_srgb(a) + linear_from_srgb(b)));
  };
  tbb::parallel_for(0, own.height(), [&](int y) {
    for (int x = 0; x < own.width(); ++x) {
      const Rgb8 mine = own(x, y), a = beside[0](x, y), b = beside[1](x, y);
      mixed(x, y) = {mix(mine.r, a.r, b.r), mix(mine.g, a.g, b.g), mix(mine.b, a.b, b.b)};
    }
  });
  return mixed;
}

StereoPair draw_for_eyes(const DrawForEye& draw, const StudyScreen& screen, const SimulatedDisplay& display,
                         const HeadPlace& head) {
  const auto draw_eye = [&](const SimulatedView& shown) {
    Image<Rgb8> own = draw(shown.view);
    if (display.crosstalk <= 0) return own;
    return with_crosstalk(own, {draw(shown.beside[0]), draw(shown.beside[1])}, display.crosstalk);
  };
  const std::array<SimulatedView, 2> shown = shown_views(display, screen, head);
  StereoPair pair;
  pair.left = draw_eye(shown[0]);
  pair.right = display.monoscopic ? pair.left : draw_eye(shown[1]);
  return pair;
}

StereoPair draw_for_eyes(const PathGraph& graph, const StudyScreen& screen, const SimulatedDisplay& display,
                         const HeadPlace& head, const GraphLook& look) {
  return draw_for_eyes([&](const EyePlace& eye) { return draw_graph(graph, screen, eye, look); }, screen, display,
                       head);
}

}  // namespace wheatstone
