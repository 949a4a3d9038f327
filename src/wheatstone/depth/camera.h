#pragma once

#include <array>
#include <optional>

#include "wheatstone/number_range.h"

namespace wheatstone {

/// Where the reference view is taken from: a pinhole camera in scene units. The axes are of length 1 and at right
/// angles; a point's pixel is centre + focal_px · (along right, along down) / depth, its depth the length along
/// `forward`.
struct Camera {
  std::array<float, 3> position{0, 0, 0};
  std::array<float, 3> right{1, 0, 0};
  std::array<float, 3> down{0, 1, 0};
  std::array<float, 3> forward{0, 0, 1};
  float focal_px = 640;
  float centre_x_px = 320;
  float centre_y_px = 180;
  float nearest_depth = 0;  ///< what is nearer, or behind the camera, is not seen
  /// Above 0: everything is as large as at this depth, an orthographic projection. The views of a rig are then sheared:
  /// parallax follows from the depth as ever.
  float orthographic_depth = 0;

  /// 1 over the depth by which a point at `depth` is scaled; times focal_px, pixels a unit of length.
  float nearness(float depth) const { return 1 / (orthographic_depth > 0 ? orthographic_depth : depth); }
};

/// The point, in scene units, that is seen at a depth and a place of the reference view, in pixels.
std::array<float, 3> point_at(const Camera& camera, float x, float y, float depth);

/// From which side, and how much of it.
struct Framing {
  float azimuth_deg = 30;        ///< around the vertical axis (z of the scene is up)
  float elevation_deg = 20;      ///< above the horizontal plane
  float field_of_view_deg = 40;  ///< across the width of a view
  float zoom = 1;                ///< 2 shows half as much
  bool orthographic = false;     ///< everything is as large as at the point that is looked at
  /// The point in the middle of the view, around which the camera turns; none: the scene's own centre.
  std::optional<std::array<float, 3>> look_at = {};
  friend bool operator==(const Framing&, const Framing&) = default;
};

/// What a framing's numbers may be. Orbits and paths turn a camera around many times.
inline constexpr NumberRange azimuth_range{-100'000, 100'000}, elevation_range{-90, 90}, field_of_view_range{1, 150},
    zoom_range{0.01, 1000};

/// Throws Error{wrong_usage} that names a number out of its range.
void check_framing(const Framing& framing);

/// A camera outside a sphere that sees just all of it, in views of the given size, in pixels. Where the framing looks
/// at another point than the sphere's centre, the camera is moved with it.
Camera camera_around(const std::array<float, 3>& centre, float radius, int width, int height,
                     const Framing& framing = {});

}  // namespace wheatstone
