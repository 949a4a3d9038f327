#include "wheatstone/depth/viewing_geometry.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace wheatstone {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Between the two lines of sight, in radians, at a distance from the eyes: eq. 2.1.5.
double vergence(const ViewingGeometry& viewing, double distance_mm) {
  return 2 * std::atan(viewing.eye_separation_mm / (2 * distance_mm));
}

}  // namespace

float perceived_depth_mm(const ViewingGeometry& viewing, float parallax_mm) {
  const float separation = viewing.eye_separation_mm;
  if (parallax_mm >= separation) return std::numeric_limits<float>::infinity();
  return viewing.viewing_distance_mm * parallax_mm / (separation - parallax_mm);
}

float screen_parallax_mm(const ViewingGeometry& viewing, float behind_mm) {
  if (std::isinf(behind_mm)) return viewing.eye_separation_mm;
  return viewing.eye_separation_mm * behind_mm / (viewing.viewing_distance_mm + behind_mm);
}

float stereoscopic_resolution(const ViewingGeometry& viewing, float near_mm, float far_mm) {
  return (screen_parallax_mm(viewing, far_mm) - screen_parallax_mm(viewing, -near_mm)) / viewing.pixel_pitch_mm();
}

float angular_disparity_deg(const ViewingGeometry& viewing, float behind_mm) {
  const double screen = viewing.viewing_distance_mm;
  return static_cast<float>((vergence(viewing, screen + behind_mm) - vergence(viewing, screen)) / degree);
}

}  // namespace wheatstone
