#include "wheatstone/depth/viewing_geometry.h"

#include <cmath>
#include <limits>

namespace wheatstone {

float perceived_depth_mm(const ViewingGeometry& viewing, float parallax_mm) {
  const float separation = viewing.eye_separation_mm;
  if (parallax_mm >= separation) return std::numeric_limits<float>::infinity();
  return viewing.viewing_distance_mm * parallax_mm / (separation - parallax_mm);
}

float screen_parallax_mm(const ViewingGeometry& viewing, float behind_mm) {
  return viewing.eye_separation_mm * behind_mm / (viewing.viewing_distance_mm + behind_mm);
}

float stereoscopic_resolution(const ViewingGeometry& viewing, float near_mm, float far_mm) {
  return (screen_parallax_mm(viewing, far_mm) - screen_parallax_mm(viewing, -near_mm)) / viewing.pixel_pitch_mm();
}

}  // namespace wheatstone
