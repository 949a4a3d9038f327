#include "wheatstone/display/anaglyph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wheatstone {
namespace {

using Matrix = std::array<std::array<float, 3>, 3>;

// Rows: red, green and blue of the result, of red, green and blue of the eye.
constexpr Matrix left_part{{{0.437f, 0.449f, 0.164f}, {-0.062f, -0.062f, -0.024f}, {-0.048f, -0.050f, -0.017f}}};
constexpr Matrix right_part{{{-0.011f, -0.032f, -0.007f}, {0.377f, 0.761f, 0.009f}, {-0.026f, -0.093f, 1.234f}}};

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const float value = static_cast<float>(i) / 255;
    table[i] = value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
  }
  return table;
}

std::uint8_t encoded(float linear) {
  const float value = std::clamp(linear, 0.f, 1.f);
  const float srgb = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * srgb));
}

float row_times(const std::array<float, 3>& row, const std::array<float, 3>& colour) {
  return std::clamp(row[0] * colour[0] + row[1] * colour[1] + row[2] * colour[2], 0.f, 1.f);
}

}  // namespace

Image<Rgb8> anaglyph(const StereoPair& pair) {
  static const std::array<float, 256> linear = make_linear_table();
  Image<Rgb8> result(pair.left.width(), pair.left.height());
  tbb::parallel_for(0, result.height(), [&](int y) {
    const auto left = pair.left.row(y), right = pair.right.row(y);
    const auto to = result.row(y);
    for (int x = 0; x < result.width(); ++x) {
      const std::array<float, 3> l{linear[left[x].r], linear[left[x].g], linear[left[x].b]};
      const std::array<float, 3> r{linear[right[x].r], linear[right[x].g], linear[right[x].b]};
      const auto channel = [&](int i) { return encoded(row_times(left_part[i], l) + row_times(right_part[i], r)); };
      to[x] = {channel(0), channel(1), channel(2)};
    }
  });
  return result;
}

}  // namespace wheatstone
