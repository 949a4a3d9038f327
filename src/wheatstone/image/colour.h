#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Linear light, 0..1, of an sRGB code value (IEC 61966-2-1).
float linear_from_srgb(std::uint8_t code);

/// The same of a code value of 16 bits, as in Rgb16.
float linear_from_deep_srgb(std::uint16_t code);

/// The nearest code value of 16 bits of linear light; outside 0..1 as the next function.
std::uint16_t deep_srgb_from_linear(float linear);

/// The nearest sRGB code value of linear light. What is below 0 or above 1 is taken as there, NaN as 0.
std::uint8_t srgb_from_linear(float linear);

/// The same for a row; both spans are equally long.
void srgb_from_linear(std::span<const float> linear, std::span<std::uint8_t> srgb);

/// How much each channel of sRGB counts in the luma of a colour (ITU-R BT.601).
inline constexpr std::array<float, 3> luma_shares{0.299f, 0.587f, 0.114f};

/// The luma of an sRGB colour, in the unit of its channels.
inline float luma_of(float red, float green, float blue) {
  return luma_shares[0] * red + luma_shares[1] * green + luma_shares[2] * blue;
}
inline float luma_of(Rgb8 colour) { return luma_of(colour.r, colour.g, colour.b); }

/// Lightness and two opponent colours in which equal steps look equal (Ottosson 2020, "A perceptual color space for
/// image processing"). White has the lightness 1; a distance of 0.02 is just noticeable (CSS Color 4).
struct Oklab {
  float lightness = 0, a = 0, b = 0;
};

/// `light` is linear: red, green and blue of sRGB, 0..1.
Oklab oklab_from_linear(const std::array<float, 3>& light);

/// The inverse. Colours outside sRGB have channels below 0 or above 1.
std::array<float, 3> linear_from_oklab(const Oklab& colour);

/// CIE L*a*b* for the white of sRGB, D65: lightness 0..100, and green to red and blue to yellow, about -110..110.
struct Cielab {
  float lightness = 0, a = 0, b = 0;
};

/// Of an sRGB colour (CIE 15; IEC 61966-2-1).
Cielab cielab_of(Rgb8 colour);

/// A colour as it is written, "#3366ff" or "3366FF": sRGB, two hexadecimal digits a channel. Nothing where the text is
/// anything else.
std::optional<Rgb8> colour_of_code(std::string_view code);

}  // namespace wheatstone
