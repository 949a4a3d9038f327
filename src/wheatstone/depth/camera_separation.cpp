#include "wheatstone/depth/camera_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheatstone {

float zero_parallax_depth(const ViewingGeometry& viewing, float near_mm, float far_mm, float nearest, float farthest) {
  const float before = -screen_parallax_mm(viewing, -near_mm);  // d_N
  const float behind = screen_parallax_mm(viewing, far_mm);     // d_F
  if (before + behind <= 0) return nearest;
  return (before + behind) / (before / farthest + behind / nearest);
}

float camera_separation(const ViewingGeometry& viewing, float near_mm, float far_mm, const SceneDepths& scene,
                        float focal_px) {
  const float pixel = scene.zero_parallax / focal_px;    // i'
  const float scale = pixel / viewing.pixel_pitch_mm();  // S
  const float before = -screen_parallax_mm(viewing, -near_mm);
  const float behind = screen_parallax_mm(viewing, far_mm);
  constexpr float unlimited = std::numeric_limits<float>::infinity();
  // Parallax on the virtual display of the two ends of the scene, for cameras one unit apart.
  const float nearest = scene.zero_parallax / scene.nearest - 1;
  const float farthest = 1 - scene.zero_parallax / scene.farthest;
  // An end that lies on the virtual display, or beyond the other, is no limit; rounding may put it just beside.
  constexpr float on_display = 1e-6f;
  const float for_nearest = nearest > on_display ? scale * before / nearest : unlimited;
  const float for_farthest = farthest > on_display ? scale * behind / farthest : unlimited;
  const float separation = std::min(for_nearest, for_farthest);
  return std::isinf(separation) ? 0 : separation;
}

float camera_parallax_px(float separation, float zero_parallax, float focal_px, float depth) {
  return separation * focal_px * (1 / zero_parallax - 1 / depth);
}

float span_of_windows(float window_mm, float eye_separation_mm, int views) {
  return static_cast<float>(views - 1) * window_mm / eye_separation_mm;
}

}  // namespace wheatstone
