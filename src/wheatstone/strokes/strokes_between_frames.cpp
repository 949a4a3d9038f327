#include "wheatstone/strokes/strokes_between_frames.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wheatstone {
namespace {

struct ShownStroke {
  float opacity = 0;  ///< as a share of the paint's, which is that of strokes that do not fade
  bool is_part = false;
};
using ShownStrokes = std::unordered_map<std::uint32_t, ShownStroke>;

ShownStrokes shown_strokes(std::span<const Layer> layers) {
  ShownStrokes shown;
  for (const Layer& layer : layers)
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.number == 0) continue;
      ShownStroke& one = shown[stroke.number];
      one = {std::max(one.opacity, stroke.opacity), stroke.is_part};
    }
  float paint = 0;
  for (const auto& [number, stroke] : shown) paint = std::max(paint, stroke.opacity);
  for (auto& [number, stroke] : shown) stroke.opacity /= paint;
  return shown;
}

}  // namespace

StrokeChanges compare_strokes(std::span<const Layer> first, std::span<const Layer> second, double largest_step) {
  const ShownStrokes before = shown_strokes(first), now = shown_strokes(second);
  constexpr float rounding = 1e-3f, whole = 1 - rounding;
  const float step = static_cast<float>(largest_step) + rounding;
  StrokeChanges changes;
  for (const auto& [number, stroke] : before) {
    const auto found = now.find(number);
    const bool is_whole = !stroke.is_part && stroke.opacity >= whole;
    changes.whole += is_whole ? 1 : 0;
    if (found == now.end()) {
      changes.hidden += is_whole ? 1 : 0;
      continue;
    }
    if (is_whole && found->second.opacity >= whole) ++changes.survived;
    if (std::abs(found->second.opacity - stroke.opacity) > step) ++changes.popped;
  }
  for (const auto& [number, stroke] : now)
    if (!before.contains(number) && stroke.opacity > step) ++changes.popped;
  return changes;
}

}  // namespace wheatstone
