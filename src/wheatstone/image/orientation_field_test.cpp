#include "wheatstone/image/orientation_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "wheatstone/random.h"

namespace wheatstone::orientation_field_test {

/// A wall whose luminance rises by so many steps a pixel to the right, with noise of each pixel's own.
Image<std::uint8_t> wall(float slope, float noise) {
  Image<std::uint8_t> luminance(320, 240);
  for (int y = 0; y < luminance.height(); ++y) {
    for (int x = 0; x < luminance.width(); ++x) {
      float sum = 0;  // of four even distributions: nearly normal, with a deviation of 1
      for (std::uint64_t part = 0; part < 4; ++part)
        sum += std::sqrt(3.f) *
               (unit_float(hash_keys({static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), part})) - 0.5f);
      const float value = 150 + slope * static_cast<float>(x) + noise * sum;
      luminance(x, y) = static_cast<std::uint8_t>(std::lround(value));
    }
  }
  return luminance;
}

/// Share of places where strokes lie within 20 degrees of a direction.
double share_along(const OrientationField& field, const Direction& wanted) {
  const double least = std::cos(20 * 3.14159265 / 180);
  int asked = 0, along = 0;
  for (int y = 5; y < 240; y += 10) {
    for (int x = 5; x < 320; x += 10) {
      const Direction is = field.along(static_cast<float>(x), static_cast<float>(y), 0, 0);
      ++asked;
      along += std::abs(is.x * wanted.x + is.y * wanted.y) >= least ? 1 : 0;
    }
  }
  return static_cast<double>(along) / asked;
}

constexpr Direction level{1, 0}, upright{0, 1};

TEST(OrientationField, IsLevelOnAPlainWallWhateverItsNoise) {
  for (const float detail_px : {3.f, 6.f, 10.f}) {
    EXPECT_EQ(share_along(OrientationField(wall(0, 0), detail_px), level), 1) << detail_px;
    EXPECT_GT(share_along(OrientationField(wall(0, 1), detail_px), level), 0.95) << detail_px;
  }
}

TEST(OrientationField, RunsAcrossAFaintSlope) {
  for (const float detail_px : {3.f, 6.f, 10.f}) {
    EXPECT_GT(share_along(OrientationField(wall(0.1f, 0), detail_px), upright), 0.95) << detail_px;
    EXPECT_GT(share_along(OrientationField(wall(0.1f, 1), detail_px), upright), 0.95) << detail_px;
  }
}

}  // namespace wheatstone::orientation_field_test
