#pragma once

#include <array>

namespace wheatstone {

/// Lightness and two opponent colours in which equal steps look equal (Ottosson 2020, "A perceptual color space for
/// image processing"). White has the lightness 1; a distance of 0.02 is just noticeable (CSS Color 4).
struct Oklab {
  float lightness = 0, a = 0, b = 0;
};

/// `light` is linear: red, green and blue of sRGB, 0..1.
Oklab oklab_from_linear(const std::array<float, 3>& light);

/// The inverse. Colours outside sRGB have channels below 0 or above 1.
std::array<float, 3> linear_from_oklab(const Oklab& colour);

}  // namespace wheatstone
