#include "wheatstone/image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace wheatstone {
namespace {

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const float value = static_cast<float>(i) / 255;
    table[i] = value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
  }
  return table;
}

}  // namespace

float linear_from_srgb(std::uint8_t code) {
  static const std::array<float, 256> table = make_linear_table();
  return table[code];
}

std::uint8_t srgb_from_linear(float linear) {
  const float value = std::clamp(linear, 0.f, 1.f);
  const float srgb = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * srgb));
}

}  // namespace wheatstone
