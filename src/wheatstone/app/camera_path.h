#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/depth/camera.h"

namespace wheatstone {

/// A keyframe: a moment of a film, and the camera's values at it. A value is empty if the keyframe leaves it open.
struct CameraKey {
  double at = 0;                           ///< 0 the first frame, 1 the last
  std::optional<double> azimuth_deg = {};  ///< Framing
  std::optional<double> elevation_deg = {};
  std::optional<double> field_of_view_deg = {};
  std::optional<double> zoom = {};
  std::optional<std::array<double, 3>> centre = {};  ///< that is looked at, in the file's units
  std::optional<double> time = {};                   ///< of the simulation (CloudSource::time)
  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

/// Keyframes of a camera that moves, `at` ascending.
struct CameraPath {
  std::vector<CameraKey> keys;
  friend bool operator==(const CameraPath&, const CameraPath&) = default;
};

/// The values at a moment: each is a smooth curve through the keys that have it, which rests at its ends and does not
/// swing beyond the keys (monotone_cubic.h); zoom changes by factors.
CameraKey camera_at(const CameraPath& path, double at);

/// Gives a framing the angles, the field of view and the zoom that a key has.
void turn_as(const CameraKey& key, Framing& framing);

/// Reads `[[key]]` tables with `at` and any of azimuth, elevation, fov, zoom, centre and time. `name` is for messages.
/// Throws Error{bad_input} where it is no TOML, has no keys, other keys or numbers that make no sense.
CameraPath parse_camera_path(std::string_view toml, const std::string& name);

/// The text that parse_camera_path reads as this path, with the same numbers.
std::string camera_path_text(const CameraPath& path);

/// The same from a file.
CameraPath read_camera_path(const std::filesystem::path& file);

}  // namespace wheatstone
