#pragma once

#include <array>
#include <optional>
#include <string>

#include "wheatstone/app/render_particles.h"

namespace wheatstone::viewer {

/// Where on the screen there is more depth than elsewhere: the options of `wheatstone render` of these names.
struct ScreenFocus {
  static constexpr float usual_radius = 0.25f, usual_gain = 1.5f;
  std::optional<std::array<float, 2>> at;  ///< from 0 to 1, from the upper left; none: the same depth everywhere
  float radius = usual_radius;             ///< as a share of the width
  float gain = usual_gain;
  friend bool operator==(const ScreenFocus&, const ScreenFocus&) = default;
};

/// How particles look, and how deep they or slices stand: the options of `wheatstone render` of these names. Empty:
/// what `render` takes without the option.
struct ParticleLook {
  Look look = Look::mass;
  std::string quantity;  ///< RenderParticlesOptions::quantity
  Stretch stretch = Stretch::asinh;
  /// Where the brightness of mass begins and ends. Empty until the first picture has found it.
  std::optional<float> least, most;
  /// What the light of the thesis's look is multiplied by. Empty until the first picture of all particles has found it.
  std::optional<float> exposure;
  bool annotated = false;                 ///< with a scale bar, a colour bar and the redshift
  std::optional<float> coldest, hottest;  ///< where the colours begin and end
  std::string colours;                    ///< a colour map's name
  float smallest_px = 2, largest_px = 6;  ///< diameter of a splat
  float opacity = 0.5f;
  bool opaque = false;
  std::optional<float> near_mm, far_mm;  ///< before and behind the display's screen
  ScreenFocus focus;
  friend bool operator==(const ParticleLook&, const ParticleLook&) = default;
};

/// The look that is drawn: opaque particles have that of the thesis.
inline Look drawn_look(const ParticleLook& look) { return look.opaque ? Look::thesis : look.look; }

/// Fills in what a picture of all particles has found.
inline void keep_brightness(ParticleLook& look, const Brightness& found) {
  if (drawn_look(look) == Look::thesis) {
    if (!look.exposure) look.exposure = found.exposure;
    return;
  }
  if (!look.least) look.least = found.least;
  if (!look.most) look.most = found.most;
}

/// Forgets what the first picture has found, for something else is shown.
inline void forget_brightness(ParticleLook& look) {
  look.exposure.reset();
  look.least.reset();
  look.most.reset();
}

}  // namespace wheatstone::viewer
