#pragma once

#include <limits>
#include <string>

#include "wheatstone/image/image.h"
#include "wheatstone/particles/appearance.h"

namespace wheatstone {

/// How numbers between two limits become brightness.
enum class Stretch {
  asinh,  ///< linear where it is faint, logarithmic where it is bright (Lupton et al. 2004)
  log,    ///< logarithmic from the lower limit on, which is above 0
  linear,
};

/// Which property of the particles' mass is shown.
enum class Shown {
  ramp,     ///< brightness is the column density, hue the mean of the column that the colours follow
  colours,  ///< the particles' own colours, which keep their hue as they add up (Lupton et al. 2004)
  column,   ///< the column density, in the colours of a map
  mean,     ///< the mean of a quantity, weighted by mass, in the colours of a map
};

/// How sums of light become colours.
struct ToneSettings {
  static constexpr float automatic = std::numeric_limits<float>::quiet_NaN();
  Look look = Look::thesis;
  float exposure = automatic;  ///< of the thesis's look: what light is multiplied by
  Shown shown = Shown::ramp;
  /// Of the thesis's look: linear shows light up to 1 as it is, anything else as L/(1+L).
  Stretch stretch = Stretch::asinh;
  /// Where brightness begins and ends: of `mean` in the scaled quantity (SplatStyle), else in light.
  float least = automatic, most = automatic;
  Rgb8 cold = usual_colours(Look::mass).cold, hot = usual_colours(Look::mass).hot;  ///< of the ramp
  std::string colour_map;  ///< of the ramp, or of numbers; empty: from `cold` to `hot`, or "inferno"
  friend bool operator==(const ToneSettings& a, const ToneSettings& b) = default;
};

}  // namespace wheatstone
