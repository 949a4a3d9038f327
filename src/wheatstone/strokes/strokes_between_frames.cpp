#include "wheatstone/strokes/strokes_between_frames.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wheatstone {
namespace {

using Opacities = std::unordered_map<std::uint32_t, float>;

Opacities opacities_of(std::span<const Layer> layers) {
  Opacities opacities;
  for (const Layer& layer : layers)
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.number == 0) continue;
      float& opacity = opacities[stroke.number];
      opacity = std::max(opacity, stroke.opacity);
    }
  return opacities;
}

float largest(const Opacities& opacities) {
  float most = 0;
  for (const auto& [number, opacity] : opacities) most = std::max(most, opacity);
  return most;
}

}  // namespace

StrokeChanges compare_strokes(std::span<const Layer> first, std::span<const Layer> second, double largest_step) {
  const Opacities before = opacities_of(first), now = opacities_of(second);
  constexpr float rounding = 1e-3f;
  const float paint = std::max(largest(before), largest(now)), whole = paint - rounding;
  const float step = static_cast<float>(largest_step) * paint + rounding;
  StrokeChanges changes;
  for (const auto& [number, opacity] : before) {
    const auto found = now.find(number);
    const bool is_whole = opacity >= whole;
    changes.whole += is_whole ? 1 : 0;
    if (found == now.end()) {
      changes.hidden += is_whole ? 1 : 0;
      continue;
    }
    if (is_whole && found->second >= whole) ++changes.survived;
    if (std::abs(found->second - opacity) > step) ++changes.popped;
  }
  for (const auto& [number, opacity] : now)
    if (!before.contains(number) && opacity > step) ++changes.popped;
  return changes;
}

}  // namespace wheatstone
