#include "wheatstone/painting/retouch_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

using Touches = std::span<const Touch>;

/// The touches of strokes, each stroke of the hand by itself.
std::vector<Touches> strokes_of_the_hand(Touches touches) {
  std::vector<Touches> all;
  for (std::size_t i = 0; i < touches.size();) {
    std::size_t end = i + 1;
    while (end < touches.size() && touches[end].goes_on && touches[end].kind == touches[i].kind) ++end;
    if (retouched_by(touches[i].kind) == Retouched::strokes) all.push_back(touches.subspan(i, end - i));
    i = end;
  }
  return all;
}

bool is_on(const Surface& surface, const Touch& touch) {
  return surface.disparity.contains(static_cast<int>(std::floor(touch.x)) - surface.left_px,
                                    static_cast<int>(std::floor(touch.y)));
}

/// The disparity under a touch, which may lie a little beside the picture.
float disparity_under(const Surface& surface, const Touch& touch) {
  const auto within = [](float at, int size) { return std::clamp(static_cast<int>(std::floor(at)), 0, size - 1); };
  const float disparity =
      surface.disparity(within(touch.x - static_cast<float>(surface.left_px), surface.disparity.width()),
                        within(touch.y, surface.disparity.height()));
  return std::isnan(disparity) ? 0 : disparity;
}

std::uint32_t next_number(const std::vector<Layer>& layers) {
  std::uint32_t largest = 0;
  for (const Layer& layer : layers) {
    largest =
        std::max(largest, static_cast<std::uint32_t>(layer.strokes.size()));  // one without a number has its place
    for (const Stroke& stroke : layer.strokes) largest = std::max(largest, stroke.number);
  }
  return largest + 1;
}

void add_stroke(Touches hand, const Surface& reference, std::vector<Layer>& layers) {
  if (std::ranges::none_of(hand, [&](const Touch& touch) { return is_on(reference, touch); })) return;
  Layer& layer = layers.back();
  Stroke stroke{.first_point = static_cast<std::uint32_t>(layer.points.size()),
                .radius_px = hand.front().radius_px,
                .colour = hand.front().colour,
                .disparity = disparity_under(reference, hand.front()),
                .reference_view = reference.view,
                .views = all_views,
                .number = next_number(layers)};
  for (const Touch& touch : hand) layer.points.push_back({touch.x, touch.y, disparity_under(reference, touch)});
  stroke.point_count = static_cast<std::uint32_t>(hand.size());
  layer.strokes.push_back(stroke);
}

/// The distance of a place from a stroke's curve, by the lines between its points.
float distance_from(const Touch& touch, const Layer& layer, const Stroke& stroke, ViewPosition view) {
  const auto points = layer.points_of(stroke);
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ControlPoint &a = points[i], &b = points[std::min(i + 1, points.size() - 1)];
    const float ax = x_in_view(a, stroke.reference_view, view), dx = x_in_view(b, stroke.reference_view, view) - ax;
    const float dy = b.y - a.y, length_squared = dx * dx + dy * dy, px = touch.x - ax, py = touch.y - a.y;
    const float t = length_squared > 0 ? std::clamp((px * dx + py * dy) / length_squared, 0.f, 1.f) : 0;
    nearest = std::min(nearest, std::hypot(px - t * dx, py - t * dy));
  }
  return nearest;
}

/// Whether the brush of a hand takes hold of a stroke. Most strokes lie above the hand's touches, or below them.
bool is_held(Touches hand, const Layer& layer, const Stroke& stroke, ViewPosition view) {
  const auto [top, bottom] = std::ranges::minmax(layer.points_of(stroke), {}, &ControlPoint::y);
  const auto [first, last] = std::ranges::minmax(hand, {}, &Touch::y);
  const float reach = std::ranges::max(hand, {}, &Touch::radius_px).radius_px;
  if (top.y > last.y + reach || bottom.y < first.y - reach) return false;
  return std::ranges::any_of(hand, [&](const Touch& touch) {
    return stroke.radius_px <= touch.radius_px && distance_from(touch, layer, stroke, view) < touch.radius_px;
  });
}

std::span<Layer> layers_above_ground(std::vector<Layer>& layers) {
  return std::span(layers).subspan(layers.size() > 1 ? 1 : 0);
}

void erase(Touches hand, ViewPosition view, std::vector<Layer>& layers) {
  for (Layer& layer : layers_above_ground(layers)) {
    const auto held = [&](const Stroke& stroke) { return is_held(hand, layer, stroke, view); };
    if (std::ranges::none_of(layer.strokes, held)) continue;
    number_by_place(layer);
    std::erase_if(layer.strokes, held);
  }
}

void recolour(Touches hand, ViewPosition view, std::vector<Layer>& layers) {
  std::vector<Stroke*> held;
  double sum = 0;
  for (Layer& layer : layers_above_ground(layers)) {
    for (Stroke& stroke : layer.strokes) {
      if (!is_held(hand, layer, stroke, view)) continue;
      held.push_back(&stroke);
      sum += luma_of(stroke.colour);
    }
  }
  const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(held.size(), 1)));
  for (Stroke* const stroke : held) {
    const float brighter = luma_of(stroke->colour) - mean;
    const auto level = [&](std::uint8_t of) {
      return static_cast<std::uint8_t>(std::clamp(static_cast<float>(of) + brighter, 0.f, 255.f) + 0.5f);
    };
    const Rgb8 colour = hand.front().colour;
    stroke->colour = {level(colour.r), level(colour.g), level(colour.b)};
    stroke->change = {};
  }
}

}  // namespace

bool has_strokes_to_retouch(const Painting& painting) {
  const auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  return strokes != nullptr && !strokes->layers.empty() && !painting.surfaces.seen.empty();
}

void retouch_strokes(std::span<const Touch> touches, Painting& painting) {
  if (!has_strokes_to_retouch(painting)) return;
  std::vector<Layer>& layers = std::get<StrokePainting>(painting.marks).layers;
  const Surface& reference = painting.surfaces.seen.front();
  for (const Touches hand : strokes_of_the_hand(touches)) {
    if (hand.front().kind == Retouch::paint)
      add_stroke(hand, reference, layers);
    else if (hand.front().kind == Retouch::erase)
      erase(hand, reference.view, layers);
    else
      recolour(hand, reference.view, layers);
  }
}

}  // namespace wheatstone
