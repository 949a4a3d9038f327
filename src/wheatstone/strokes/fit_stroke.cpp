#include "wheatstone/strokes/fit_stroke_internal.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "wheatstone/random.h"
#include "wheatstone/strokes/footprint_internal.h"

namespace wheatstone {
namespace {

FitColour operator+(const FitColour& a, const FitColour& b) {
  return {a.luminance + b.luminance, a.red + b.red, a.blue + b.blue};
}
FitColour operator*(float f, const FitColour& a) { return {f * a.luminance, f * a.red, f * a.blue}; }

/// The path of a stroke, from point to point, and the place of the point where it was begun.
struct Path {
  std::vector<PlanePoint> points;
  std::size_t begun = 0;
  bool is_dab = false;  ///< it follows no line of the picture
};

float step_px(float radius_px) { return std::max(0.7f * radius_px, 1.f); }
float longest_px(float radius_px) { return 9 * radius_px + 4; }

/// Follows the picture's lines from a point, one way.
void follow(const FitTile& tile, const LayerPlan& plan, PlanePoint from, Direction direction,
            std::vector<PlanePoint>& points) {
  const float step = step_px(plan.radius_px);
  const float tolerance = 5 + 0.15f * plan.radius_px;
  const int begun_x = static_cast<int>(from.x), begun_y = static_cast<int>(from.y);
  const FitColour colour = tile.wanted(begun_x, begun_y);
  float last_disparity = tile.disparity(begun_x, begun_y);
  for (float length = step; length <= longest_px(plan.radius_px) / 2; length += step) {
    const PlanePoint next{from.x + step * direction.x, from.y + step * direction.y};
    if (!tile.contains(next.x, next.y)) return;
    const int x = static_cast<int>(next.x), y = static_cast<int>(next.y);
    const float disparity = tile.disparity(x, y);
    if (std::abs(disparity - last_disparity) > plan.depth_threshold_px) return;
    last_disparity = disparity;
    const FitColour wanted = tile.wanted(x, y);
    const float unlike = squared(wanted - colour);
    if (unlike > tolerance * tolerance) return;
    // Hertzmann 1998, sec. 2.2: the canvas is already nearer to the picture than the stroke's colour would be.
    if (!tile.is_bare(x, y) && squared(wanted - tile.painted(x, y)) < 0.6f * unlike) return;
    points.push_back(next);
    from = next;
    Direction turned = plan.reference->orientation.along(static_cast<float>(tile.left) + next.x,
                                                         static_cast<float>(tile.top) + next.y, 0, 0);
    const float ahead = turned.x * direction.x + turned.y * direction.y;
    if (ahead < 0) turned = {-turned.x, -turned.y};
    constexpr float sharpest_turn = 0.3f, remembered = 0.4f;
    if (std::abs(ahead) < sharpest_turn) return;
    direction = {remembered * direction.x + (1 - remembered) * turned.x,
                 remembered * direction.y + (1 - remembered) * turned.y};
    const float norm = std::hypot(direction.x, direction.y);
    direction = {direction.x / norm, direction.y / norm};
  }
}

/// Strokes of a point or two would be discs: they go on a little on their surface, whatever colour is there.
void lengthen(const FitTile& tile, const LayerPlan& plan, Direction direction, Path& path) {
  const PlanePoint middle = path.points[path.begun];
  const auto disparity_at = [&](PlanePoint p) { return tile.disparity(static_cast<int>(p.x), static_cast<int>(p.y)); };
  const float half_length = std::max(1.8f * plan.radius_px, 2.5f);
  path.points = {middle};
  for (const float way : {-half_length, half_length}) {
    const PlanePoint end{middle.x + way * direction.x, middle.y + way * direction.y};
    if (tile.contains(end.x, end.y) && std::abs(disparity_at(end) - disparity_at(middle)) <= plan.depth_threshold_px)
      path.points.insert(way < 0 ? path.points.begin() : path.points.end(), end);
  }
  path.begun = path.points.size() / 2;
}

Path trace_both_ways(const FitTile& tile, const LayerPlan& plan, int x, int y) {
  const PlanePoint begin{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  const Direction direction = plan.reference->orientation.along(static_cast<float>(tile.left) + begin.x,
                                                                static_cast<float>(tile.top) + begin.y, 0, 0);
  Path path;
  follow(tile, plan, begin, {-direction.x, -direction.y}, path.points);
  std::ranges::reverse(path.points);
  path.begun = path.points.size();
  path.points.push_back(begin);
  follow(tile, plan, begin, direction, path.points);
  path.is_dab = path.points.size() < 3;
  if (path.is_dab) lengthen(tile, plan, direction, path);
  return path;
}

/// At most four control points of a part of a path, the ends among them.
std::vector<PlanePoint> control_points(std::span<const PlanePoint> path) {
  constexpr std::size_t most = 4;
  if (path.size() <= most) return {path.begin(), path.end()};
  std::vector<PlanePoint> points;
  for (std::size_t i = 0; i < most; ++i) points.push_back(path[(i * (path.size() - 1) + (most - 1) / 2) / (most - 1)]);
  return points;
}

/// Sums over the pixels of a stroke, from which a colour that changes evenly along it is fitted by least squares.
struct Moments {
  float weight = 0, along = 0, along_squared = 0;  ///< Σw, Σwt, Σwt²
  FitColour colour, colour_along;                  ///< Σwc, Σwtc
  float colour_squared = 0;                        ///< Σw|c|²
  float before = 0;                                ///< error before the stroke is painted

  void add(float w, float t, const FitColour& c) {
    weight += w;
    along += w * t;
    along_squared += w * t * t;
    colour = colour + w * c;
    colour_along = colour_along + w * t * c;
    colour_squared += w * squared(c);
  }
  void add(const Moments& other) {
    weight += other.weight;
    along += other.along;
    along_squared += other.along_squared;
    colour = colour + other.colour;
    colour_along = colour_along + other.colour_along;
    colour_squared += other.colour_squared;
    before += other.before;
  }
};

/// A colour that is `begin` at t = 0 and `begin + change` at t = 1.
struct EvenChange {
  FitColour begin, change;
};

EvenChange fit_colour(const Moments& m) {
  // A brush carries one colour and takes up some of what it meets: less change than fits best. Soft gradients stay
  // soft.
  constexpr float taken_up = 0.6f, soft_change = 5;
  const float mean_along = m.along / m.weight;
  const FitColour mean = (1 / m.weight) * m.colour;
  const float variance = m.along_squared / m.weight - mean_along * mean_along;
  FitColour change;
  if (variance > 1e-3f) change = (1 / (variance * m.weight)) * (m.colour_along - mean_along * m.colour);
  const float size = std::sqrt(squared(change));
  if (size > soft_change) change = std::max(soft_change / size, taken_up) * change;
  return {mean - mean_along * change, change};
}

/// Error that is left where a stroke has this colour.
float error_left(const Moments& m, const EvenChange& fitted) {
  const auto& [a, b] = fitted;
  const auto dot = [](const FitColour& p, const FitColour& q) {
    return p.luminance * q.luminance + p.red * q.red + p.blue * q.blue;
  };
  return m.colour_squared - 2 * dot(a, m.colour) - 2 * dot(b, m.colour_along) + m.weight * squared(a) +
         2 * m.along * dot(a, b) + m.along_squared * squared(b);
}

constexpr std::array width_shares{0.5f, 0.72f, 1.f};  ///< of the layer's radius, narrow to wide
constexpr std::array length_shares{0.3f, 0.6f, 1.f};  ///< of the traced path
constexpr float narrowest_px = 0.7f;

/// Points [first, end) of a path that is shortened to a share of it, about the point where it was begun.
struct PathPart {
  std::size_t first, end;
};
PathPart shortened(const Path& path, float share, std::size_t least) {
  const std::size_t count = path.points.size();
  const std::size_t kept = std::clamp(static_cast<std::size_t>(std::lround(share * static_cast<float>(count))),
                                      std::min(least, count), count);
  const std::size_t before = std::min(path.begun, kept / 2);
  const std::size_t first = std::min(path.begun - before, count - kept);
  return {first, first + kept};
}

/// Whether a pixel is of another surface than a stroke: nearer, which hides the stroke, or farther, over which it
/// would spill.
enum class Side { own, nearer, farther };
Side side_of(float disparity, float of_stroke, float threshold) {
  if (disparity > of_stroke + threshold) return Side::nearer;
  return disparity < of_stroke - threshold ? Side::farther : Side::own;
}

FitColour varied(std::uint64_t random) {
  constexpr float steps = 0.8f;  // below what the eye sees as another colour, between neighbours
  const auto part = [&](std::uint64_t which) { return unit_float(hash_keys({random, which})) - 0.5f; };
  return {steps * part(1), 0.3f * steps * part(2), 0.3f * steps * part(3)};
}

}  // namespace

FitTile::FitTile(const LayerPlan& plan, PaintedPicture& canvas, int left_, int top_, int right, int bottom)
    : left(std::max(left_, 0)),
      top(std::max(top_, 0)),
      width(std::min(right, canvas.width()) - left),
      height(std::min(bottom, canvas.height()) - top),
      plan_(plan),
      canvas_(canvas),
      weights_(difference_weights(plan, {left, top, left + width, top + height})),
      error_(at(0, height)) {
  const auto row_of = [&](auto& values, int y) {
    return std::span(values).subspan(at(0, y), static_cast<std::size_t>(width));
  };
  for (int y = 0; y < height; ++y) errors_of_row(plan, canvas, left, top + y, row_of(weights_, y), row_of(error_, y));
}

void errors_of_row(const LayerPlan& plan, const PaintedPicture& canvas, int left, int y, std::span<const float> weights,
                   std::span<float> errors) {
  const auto row = [&](const auto& plane) { return &plane(left, y); };
  const auto *red = row(plan.reference->red), *green = row(plan.reference->green), *blue = row(plan.reference->blue);
  const PaintedPixel* const paint = row(canvas);
  // A loop that compilers turn into vectors.
  for (std::size_t x = 0; x < errors.size(); ++x) {
    const auto left_of = [](int level, std::uint16_t painted) {
      return static_cast<float>(level) - static_cast<float>(painted) / PaintedPixel::steps;
    };
    errors[x] = error_of(FitColour::of(left_of(red[x], paint[x].red), left_of(green[x], paint[x].green),
                                       left_of(blue[x], paint[x].blue)),
                         paint[x].is_bare(), weights[x]);
  }
}

void FitTile::paint(int x, int y, const FitColour& colour, float cover) {
  PaintedPixel& pixel = canvas_(left + x, top + y);
  const FitColour before = pixel.colour();
  pixel = PaintedPixel::of(pixel.is_bare() ? colour : before + cover * (colour - before),
                           std::max(pixel.coverage(), cover));
  error_[at(x, y)] = error_of(wanted(x, y) - pixel.colour(), pixel.is_bare(), weight(x, y));
}

float fitted_reach_px(float radius_px) { return longest_px(radius_px) / 2 + radius_px + 2; }

namespace {

/// The best stroke along a path: its length, as a number of length_shares, width, colour, and gain.
struct PathFit {
  std::size_t length = 0;
  float radius_px = 0;
  EvenChange colour;
  float gain = 0;
};

/// The share of a path at one of its points.
float share_of_path(const Path& path, std::size_t point) {
  return path.points.size() > 1 ? static_cast<float>(point) / static_cast<float>(path.points.size() - 1) : 0;
}

std::size_t least_points(const Path& path) { return path.points.size() > 1 ? 2 : 1; }

/// From every `row_step`th row of its pixels.
PathFit fit_along(const Path& path, const FitTile& tile, const LayerPlan& plan, const FitColour& variation,
                  int row_step) {
  const float radius = plan.radius_px;
  const PlanePoint& middle = path.points[path.begun];
  const float of_stroke = tile.disparity(static_cast<int>(middle.x), static_cast<int>(middle.y));

  // Moments of the pixels by the narrowest stroke and the shortest part of the path that they belong to.
  std::array<std::array<Moments, width_shares.size()>, length_shares.size()> moments{};
  std::array<std::array<float, 2>, length_shares.size()> within{};  // shares of the path
  const float cap =
      0.6f * radius / (step_px(radius) * static_cast<float>(std::max<std::size_t>(path.points.size(), 2) - 1));
  for (std::size_t l = 0; l < length_shares.size(); ++l) {
    const auto [first, end] = shortened(path, length_shares[l], least_points(path));
    within[l] = {share_of_path(path, first) - cap, share_of_path(path, end - 1) + cap};
  }
  thread_local Footprint footprint;
  const auto add = [&](int x, int y, float distance, float share) {
    const Side side = side_of(tile.disparity(x, y), of_stroke, plan.depth_threshold_px);
    if (side == Side::nearer) return;
    std::size_t l = 0, w = 0;
    while (l + 1 < length_shares.size() && (share < within[l][0] || share > within[l][1])) ++l;
    while (w + 1 < width_shares.size() && distance > width_shares[w] * radius) ++w;
    Moments& bin = moments[l][w];
    constexpr float spill = 60;
    if (side == Side::farther) bin.before -= spill;
    bin.before += tile.error(x, y);
    bin.add(tile.weight(x, y), share, tile.wanted(x, y));
  };
  footprint.visit(tile, control_points(path.points), radius, row_step, add);
  for (std::size_t l = 0; l < length_shares.size(); ++l) {
    for (std::size_t w = 1; w < width_shares.size(); ++w) moments[l][w].add(moments[l][w - 1]);
    if (l > 0)
      for (std::size_t w = 0; w < width_shares.size(); ++w) moments[l][w].add(moments[l - 1][w]);
  }

  PathFit best;
  for (std::size_t l = 0; l < length_shares.size(); ++l) {
    for (std::size_t w = 0; w < width_shares.size(); ++w) {
      if (width_shares[w] * radius < narrowest_px && w + 1 < width_shares.size()) continue;
      const Moments& m = moments[l][w];
      if (m.weight <= 0) continue;
      EvenChange colour = fit_colour(m);
      colour.begin = colour.begin + variation;
      const float gain = static_cast<float>(row_step) * (m.before - error_left(m, colour));
      if (gain > best.gain) best = {l, width_shares[w] * radius, colour, gain};
    }
  }
  return best;
}

/// Whether a few rows of a broad stroke show clearly that it gains too little, as most strokes do.
bool is_hopeless(const Path& path, const FitTile& tile, const LayerPlan& plan, const FitColour& variation) {
  constexpr float thinned_px = 2, clearly = 0.5f;
  if (plan.radius_px < thinned_px) return false;
  const int row_step = plan.radius_px < 2 * thinned_px ? 2 : 4;
  return fit_along(path, tile, plan, variation, row_step).gain < clearly * plan.least_gain;
}

}  // namespace

std::optional<FittedStroke> fit_stroke(const FitTile& tile, const LayerPlan& plan, int x, int y, std::uint64_t random) {
  const Path path = trace_both_ways(tile, plan, x, y);
  const FitColour variation = varied(random);
  if (is_hopeless(path, tile, plan, variation)) return {};
  const PathFit best = fit_along(path, tile, plan, variation, 1);
  constexpr float of_dab = 3.5f;  // a dab alone looks like a speck
  if (best.gain < (path.is_dab ? of_dab : 1) * plan.least_gain) return {};
  const auto [first, end] = shortened(path, length_shares[best.length], least_points(path));
  const auto colour_at = [&](std::size_t point) {
    return best.colour.begin + share_of_path(path, point) * best.colour.change;
  };
  std::vector<PlanePoint> points = control_points(std::span(path.points).subspan(first, end - first));
  const PlanePoint middle = points[points.size() / 2];
  return FittedStroke{std::move(points), best.radius_px, colour_at(first), colour_at(end - 1),
                      tile.disparity(static_cast<int>(middle.x), static_cast<int>(middle.y))};
}

void paint_stroke(const FittedStroke& stroke, const LayerPlan& plan, FitTile& tile) {
  thread_local Footprint footprint;
  const BrushProfile brush(stroke.radius_px);
  footprint.visit(tile, stroke.points, brush.reach_px, 1, [&](int x, int y, float distance, float share) {
    if (side_of(tile.disparity(x, y), stroke.disparity, plan.depth_threshold_px) == Side::nearer) return;
    tile.paint(x, y, stroke.begin + share * (stroke.end - stroke.begin), brush.cover(distance));
  });
}

}  // namespace wheatstone
