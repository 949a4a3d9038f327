#pragma once

#include <cstdint>
#include <span>

namespace wheatstone {

/// Linear light, 0..1, of an sRGB code value (IEC 61966-2-1).
float linear_from_srgb(std::uint8_t code);

/// The nearest sRGB code value of linear light. What is below 0 or above 1 is taken as there, NaN as 0.
std::uint8_t srgb_from_linear(float linear);

/// The same for a row; both spans are equally long.
void srgb_from_linear(std::span<const float> linear, std::span<std::uint8_t> srgb);

}  // namespace wheatstone
