#pragma once

#include <bit>
#include <cstdint>

namespace wheatstone {

/// The value of a half float that is not negative, one at a time: its bits as a float's, whose exponent counts from 112
/// lower.
inline float float_from_half(std::uint16_t bits) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 13) * 0x1p112f;
}

}  // namespace wheatstone
