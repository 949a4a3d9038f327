#pragma once

#include <optional>
#include <string>

namespace wheatstone::viewer {

/// How particles look, and how deep they or slices stand: the options of `wheatstone render` of these names. Empty:
/// what `render` takes without the option.
struct ParticleLook {
  /// What the light is multiplied by. Empty until the first picture of all particles has found it.
  std::optional<float> exposure;
  std::optional<float> coldest, hottest;  ///< where the colours begin and end
  std::string colours;                    ///< a colour map's name
  float smallest_px = 2, largest_px = 6;  ///< diameter of a splat
  float opacity = 0.5f;
  bool opaque = false;
  std::optional<float> near_mm, far_mm;  ///< before and behind the display's screen
  friend bool operator==(const ParticleLook&, const ParticleLook&) = default;
};

}  // namespace wheatstone::viewer
