#include "wheatstone/image/srgb.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace wheatstone {
namespace {

double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(linear_of(i / 255.));
  return table;
}

/// Code values by linear light. The curve is steepest at 0, where 1/4096 of the light is 0.8 code values: between two
/// entries the code value rises once at most, and one comparison tells whether it has.
class Encoder {
 public:
  Encoder() {
    for (int code = 0; code < 255; ++code) {
      const double exact = linear_of((code + 0.5) / 255);
      const auto rounded = static_cast<float>(exact);
      rise_[code] = rounded < exact ? std::nextafter(rounded, 1.f) : rounded;
    }
    rise_[255] = std::numeric_limits<float>::infinity();
    int code = 0;
    for (int entry = 0; entry <= entries; ++entry) {
      while (static_cast<float>(entry) / entries >= rise_[code]) ++code;
      lowest_[entry] = static_cast<std::uint8_t>(code);
    }
  }

  std::uint8_t operator()(float linear) const {
    // In this order NaN becomes 0.
    const float value = std::min(std::max(0.f, linear), 1.f);
    const std::uint8_t code = lowest_[static_cast<int>(value * entries)];
    return static_cast<std::uint8_t>(code + (value >= rise_[code]));
  }

 private:
  static constexpr int entries = 4096;              // a power of two: the product above is exact
  std::array<float, 256> rise_{};                   // the least light of the code value after each
  std::array<std::uint8_t, entries + 1> lowest_{};  // at each entry
};

const Encoder& encoder() {
  static const Encoder instance;
  return instance;
}

}  // namespace

float linear_from_srgb(std::uint8_t code) {
  static const std::array<float, 256> table = make_linear_table();
  return table[code];
}

std::uint8_t srgb_from_linear(float linear) { return encoder()(linear); }

void srgb_from_linear(std::span<const float> linear, std::span<std::uint8_t> srgb) {
  assert(linear.size() == srgb.size());
  const Encoder& encoded = encoder();
  for (std::size_t i = 0; i < srgb.size(); ++i) srgb[i] = encoded(linear[i]);
}

}  // namespace wheatstone
