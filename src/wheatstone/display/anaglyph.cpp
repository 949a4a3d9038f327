#include "wheatstone/display/anaglyph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "wheatstone/image/srgb.h"

namespace wheatstone {
namespace {

using Matrix = std::array<std::array<float, 3>, 3>;

// Rows: red, green and blue of the result, of red, green and blue of the eye.
constexpr Matrix left_part{{{0.437f, 0.449f, 0.164f}, {-0.062f, -0.062f, -0.024f}, {-0.048f, -0.050f, -0.017f}}};
constexpr Matrix right_part{{{-0.011f, -0.032f, -0.007f}, {0.377f, 0.761f, 0.009f}, {-0.026f, -0.093f, 1.234f}}};

std::array<float, 3> linear_of(Rgb8 colour) {
  return {linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)};
}

float row_times(const std::array<float, 3>& row, const std::array<float, 3>& colour) {
  return std::clamp(row[0] * colour[0] + row[1] * colour[1] + row[2] * colour[2], 0.f, 1.f);
}

}  // namespace

Image<Rgb8> anaglyph(const StereoPair& pair) {
  Image<Rgb8> result(pair.left.width(), pair.left.height());
  tbb::parallel_for(0, result.height(), [&](int y) {
    const auto left = pair.left.row(y), right = pair.right.row(y);
    const auto to = result.row(y);
    for (int x = 0; x < result.width(); ++x) {
      const std::array<float, 3> l = linear_of(left[x]), r = linear_of(right[x]);
      const auto channel = [&](int i) {
        return srgb_from_linear(row_times(left_part[i], l) + row_times(right_part[i], r));
      };
      to[x] = {channel(0), channel(1), channel(2)};
    }
  });
  return result;
}

}  // namespace wheatstone
