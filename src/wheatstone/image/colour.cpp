#include "wheatstone/image/colour.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace wheatstone {
namespace {

double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

double srgb_of(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The light of each code value.
template <std::size_t codes>
std::array<float, codes> make_linear_table() {
  std::array<float, codes> table{};
  for (std::size_t i = 0; i < codes; ++i)
    table[i] = static_cast<float>(linear_of(static_cast<double>(i) / static_cast<double>(codes - 1)));
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
  static const std::array<float, 256> table = make_linear_table<256>();
  return table[code];
}

float linear_from_deep_srgb(std::uint16_t code) {
  static const std::array<float, 65536> table = make_linear_table<65536>();
  return table[code];
}

std::uint16_t deep_srgb_from_linear(float linear) {
  const float value = std::min(std::max(0.f, linear), 1.f);  // in this order NaN becomes 0
  return static_cast<std::uint16_t>(std::lround(65535 * srgb_of(value)));
}

std::uint8_t srgb_from_linear(float linear) { return encoder()(linear); }

void srgb_from_linear(std::span<const float> linear, std::span<std::uint8_t> srgb) {
  assert(linear.size() == srgb.size());
  const Encoder& encoded = encoder();
  for (std::size_t i = 0; i < srgb.size(); ++i) srgb[i] = encoded(linear[i]);
}

Oklab oklab_from_linear(const std::array<float, 3>& light) {
  const auto [r, g, b] = light;
  const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
  const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
  const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
  return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
          1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
          0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

std::array<float, 3> linear_from_oklab(const Oklab& colour) {
  const auto cube = [](float x) { return x * x * x; };
  const float l = cube(colour.lightness + 0.3963377774f * colour.a + 0.2158037573f * colour.b);
  const float m = cube(colour.lightness - 0.1055613458f * colour.a - 0.0638541728f * colour.b);
  const float s = cube(colour.lightness - 0.0894841775f * colour.a - 1.2914855480f * colour.b);
  return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
          -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
          -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

Cielab cielab_of(Rgb8 colour) {
  const float red = linear_from_srgb(colour.r), green = linear_from_srgb(colour.g), blue = linear_from_srgb(colour.b);
  // Each is a share of the white's.
  const float x = (0.412453f * red + 0.357580f * green + 0.180423f * blue) / 0.950456f;
  const float y = 0.212671f * red + 0.715160f * green + 0.072169f * blue;
  const float z = (0.019334f * red + 0.119193f * green + 0.950227f * blue) / 1.088754f;
  constexpr float dark = 216.f / 24389, slope = 24389.f / (27 * 116);
  const auto curve = [](float share) { return share > dark ? std::cbrt(share) : slope * share + 16.f / 116; };
  const float from_y = curve(y);
  return {116 * from_y - 16, 500 * (curve(x) - from_y), 200 * (from_y - curve(z))};
}

std::optional<Rgb8> colour_of_code(std::string_view code) {
  if (code.starts_with('#')) code.remove_prefix(1);
  const auto is_hexadecimal = [](unsigned char c) { return std::isxdigit(c) != 0; };
  if (code.size() != 6 || !std::ranges::all_of(code, is_hexadecimal)) return std::nullopt;
  unsigned value = 0;
  std::from_chars(code.data(), code.data() + code.size(), value, 16);
  return Rgb8{static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 0xFF),
              static_cast<std::uint8_t>(value & 0xFF)};
}

}  // namespace wheatstone
