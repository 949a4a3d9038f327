#pragma once

#include <algorithm>

namespace wheatstone {

/// Moves the ends of a scene's range, a part of the way for each frame of a film, toward those of a frame that reaches
/// farther; never back, so that nothing moves to and fro within a scene.
inline void widen_slowly(float frame_farthest, float frame_nearest, float& farthest, float& nearest) {
  constexpr float frames_to_reach = 24;
  farthest += std::min(frame_farthest - farthest, 0.f) / frames_to_reach;
  nearest += std::max(frame_nearest - nearest, 0.f) / frames_to_reach;
}

}  // namespace wheatstone
