#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace wheatstone::viewer {

/// Where a head is and where it looks, as OpenTrack's output "UDP over network" tells it.
struct HeadPose {
  double x_cm = 0, y_cm = 0, z_cm = 0;  ///< to the right, up, away from the screen
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

/// A packet is these six numbers, little-endian, in this order; none where it has another size or a number is not
/// finite.
std::optional<HeadPose> parse_opentrack(std::span<const std::byte> packet);

}  // namespace wheatstone::viewer
