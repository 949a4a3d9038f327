#include "wheatstone/depth/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheatstone {

std::array<float, 3> point_at(const Camera& camera, float x, float y, float depth) {
  const float units_a_px = 1 / (camera.focal_px * camera.nearness(depth));
  const float along = (x - camera.centre_x_px) * units_a_px, down = (y - camera.centre_y_px) * units_a_px;
  std::array<float, 3> point{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] =
        camera.position[axis] + camera.right[axis] * along + camera.down[axis] * down + camera.forward[axis] * depth;
  return point;
}

void check_framing(const Framing& framing) {
  check_number("azimuth", framing.azimuth_deg, azimuth_range);
  check_number("elevation", framing.elevation_deg, elevation_range);
  check_number("fov", framing.field_of_view_deg, field_of_view_range);
  check_number("zoom", framing.zoom, zoom_range);
}

Camera camera_around(const std::array<float, 3>& centre, float radius, int width, int height, const Framing& framing) {
  constexpr float degree = std::numbers::pi_v<float> / 180;
  const float azimuth = framing.azimuth_deg * degree;
  const float elevation = framing.elevation_deg * degree;
  const float half_width = std::tan(framing.field_of_view_deg * degree / 2);
  const float half_height = half_width * static_cast<float>(height) / static_cast<float>(width);

  Camera camera;
  camera.forward = {-std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                    -std::sin(elevation)};
  camera.right = {-std::sin(azimuth), std::cos(azimuth), 0};
  camera.down = {std::sin(elevation) * std::cos(azimuth), std::sin(elevation) * std::sin(azimuth),
                 -std::cos(elevation)};
  // The sphere touches the narrower pair of the frustum's sides.
  const float distance = radius / std::sin(std::atan(std::min(half_width, half_height)));
  const std::array<float, 3> middle = framing.look_at.value_or(centre);
  for (std::size_t axis = 0; axis < 3; ++axis) camera.position[axis] = middle[axis] - distance * camera.forward[axis];
  camera.focal_px = framing.zoom * static_cast<float>(width) / (2 * half_width);
  camera.centre_x_px = static_cast<float>(width) / 2;
  camera.centre_y_px = static_cast<float>(height) / 2;
  camera.nearest_depth = distance / 1000;
  if (framing.orthographic) camera.orthographic_depth = distance;
  return camera;
}

}  // namespace wheatstone
