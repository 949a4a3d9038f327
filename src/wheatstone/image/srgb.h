#pragma once

#include <cstdint>

namespace wheatstone {

/// Linear light, 0..1, of an sRGB code value (IEC 61966-2-1).
float linear_from_srgb(std::uint8_t code);

/// The nearest sRGB code value of linear light; what is below 0 or above 1 is taken as there.
std::uint8_t srgb_from_linear(float linear);

}  // namespace wheatstone
