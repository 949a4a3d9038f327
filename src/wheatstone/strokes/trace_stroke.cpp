#include "wheatstone/strokes/trace_stroke_internal.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheatstone/marks/residual.h"

namespace wheatstone {
namespace {

struct Rgb {
  float red, green, blue;
};

float squared_distance(const Rgb& a, const Rgb& b) {
  const float red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
  return red * red + green * green + blue * blue;
}

Rgb reference_at(const ReferencePicture& reference, int x, int y) {
  return {static_cast<float>(reference.red(x, y)), static_cast<float>(reference.green(x, y)),
          static_cast<float>(reference.blue(x, y))};
}

/// Sobel's gradient of the reference's luminance, in steps a pixel.
Direction gradient_at(const ImageView<const std::uint8_t>& luminance, int x, int y) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, luminance.width() - 1);
  const auto above = luminance.row(std::max(y - 1, 0)), here = luminance.row(y);
  const auto below = luminance.row(std::min(y + 1, luminance.height() - 1));
  const int gx = (above[right] + 2 * here[right] + below[right]) - (above[left] + 2 * here[left] + below[left]);
  const int gy = (below[left] + 2 * below[x] + below[right]) - (above[left] + 2 * above[x] + above[right]);
  return {static_cast<float>(gx) / 8, static_cast<float>(gy) / 8};
}

/// The direction in which a stroke leaves a pixel, or nothing where the style ends strokes at a vanishing gradient.
std::optional<Direction> direction_at(const LayerPlan& plan, float x, float y) {
  const Direction gradient = gradient_at(plan.reference->luminance, static_cast<int>(x), static_cast<int>(y));
  if (plan.style.orientation == Orientation::smooth)
    return plan.reference->orientation.along(x, y, gradient.x, gradient.y);
  const float magnitude = std::hypot(gradient.x, gradient.y);
  constexpr float vanishing = 0.5f;  // half a luminance step a pixel: below it 8-bit rounding decides
  if (magnitude < vanishing) return {};
  return Direction{-gradient.y / magnitude, gradient.x / magnitude};
}

/// The new direction turned into the sense of the last one and mixed with it by the curvature filter f_c.
Direction filtered(Direction direction, const Direction& last, float curvature) {
  if (direction.x * last.x + direction.y * last.y < 0) direction = {-direction.x, -direction.y};
  direction = {curvature * direction.x + (1 - curvature) * last.x, curvature * direction.y + (1 - curvature) * last.y};
  const float length = std::hypot(direction.x, direction.y);
  return length > 0 ? Direction{direction.x / length, direction.y / length} : last;
}

/// True where the disparity jumps somewhere on the way from one point to the next.
bool crosses_depth_edge(const LayerPlan& plan, const ControlPoint& from, const ControlPoint& to) {
  const int steps = std::max(static_cast<int>(std::ceil(plan.radius_px)), 1);
  float last = from.disparity;
  for (int i = 1; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    const float disparity = plan.view.disparity(static_cast<int>(from.x + t * (to.x - from.x)),
                                                static_cast<int>(from.y + t * (to.y - from.y)));
    if (std::abs(disparity - last) > plan.depth_threshold_px) return true;
    last = disparity;
  }
  return std::abs(to.disparity - from.disparity) > plan.depth_threshold_px;
}

/// True where a stroke would come to lie on paint although the picture's colour there is unlike its own: one of the
/// least length would cover small things that no finer layer need bring back.
bool would_cover_unlike(const LayerPlan& plan, const CanvasRows& rows, const Rgb& colour, const ControlPoint& to) {
  const int x = static_cast<int>(to.x), y = static_cast<int>(to.y);
  const bool bare = rows.canvas.coverage(x, y - rows.top) < 0.5f;
  return !bare && squared_distance(reference_at(*plan.reference, x, y), colour) > unlike_colours * unlike_colours;
}

/// Criterion (d): paint would spill onto another surface, around the next point or on the way to it. A stroke that was
/// set down edgeways, narrower than the layer's brush, needs no more room than its own radius.
bool would_spill(const LayerPlan& plan, float radius_px, bool edgeways, const ControlPoint& from,
                 const ControlPoint& to) {
  if (plan.depth_edges.empty()) return false;
  const int x = static_cast<int>(to.x), y = static_cast<int>(to.y);
  if (!edgeways && plan.depth_edges(x, y) != 0) return true;
  constexpr float rounding_px = 0.5f;
  if (edgeways && plan.edge_distance(x, y) < radius_px - rounding_px) return true;
  return crosses_depth_edge(plan, from, to);
}

}  // namespace

int traced_reach_px(const LayerPlan& plan) {
  return static_cast<int>(std::ceil(static_cast<float>(plan.style.max_length) * plan.radius_px)) + 1;
}

void trace_stroke(const LayerPlan& plan, const CanvasRows& rows, const StrokeStart& start,
                  std::vector<ControlPoint>& points) {
  const Style& style = plan.style;
  const Seed& seed = start.seed;
  const Rgb colour = reference_at(*plan.reference, seed.x, seed.y);
  const auto width = static_cast<float>(plan.canvas.width), height = static_cast<float>(plan.canvas.height);
  ControlPoint point{static_cast<float>(seed.x) + 0.5f, static_cast<float>(seed.y) + 0.5f,
                     plan.view.disparity(seed.x, seed.y)};
  points.push_back(point);
  const bool edgeways = !plan.depth_edges.empty() && plan.depth_edges(seed.x, seed.y) != 0;
  const int longest = edgeways && !style.follow_depth_edges ? 1 : style.max_length;
  std::optional<Direction> last;
  for (int length = 1; length < longest; ++length) {
    const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);

    // (b) the canvas is already nearer to the picture than the stroke's colour would be
    const Rgb wanted = reference_at(*plan.reference, x, y);
    const Canvas& canvas = rows.canvas;
    const int row = y - rows.top;
    const Rgb painted{canvas.red(x, row), canvas.green(x, row), canvas.blue(x, row)};
    const bool bare = canvas.coverage(x, row) < 0.5f;
    if (length >= style.min_length && !bare && squared_distance(wanted, painted) < squared_distance(wanted, colour)) {
      return;
    }

    // (c) no direction to go on in
    std::optional<Direction> direction = direction_at(plan, point.x, point.y);
    if (!direction) return;
    if (last) {
      direction = filtered(*direction, *last, style.curvature);
    } else if (start.backwards) {
      direction = Direction{-direction->x, -direction->y};
    }
    last = direction;

    ControlPoint next{point.x + plan.radius_px * direction->x, point.y + plan.radius_px * direction->y, 0};
    if (!(next.x >= 0 && next.y >= 0 && next.x < width && next.y < height)) return;
    next.disparity = plan.view.disparity(static_cast<int>(next.x), static_cast<int>(next.y));
    if (would_spill(plan, start.radius_px, edgeways, point, next) || would_cover_unlike(plan, rows, colour, next))
      return;
    points.push_back(next);
    point = next;
  }
}

}  // namespace wheatstone
