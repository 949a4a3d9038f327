#include "wheatstone/image/colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wheatstone::colour_test {

/// IEC 61966-2-1, not rounded.
double code_by_formula(double linear) {
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// Light all over 0..1, denser where it is dark, and next to every place where the code value changes.
std::vector<float> many_lights() {
  std::vector<float> lights;
  for (int i = 0; i <= 1 << 18; ++i) {
    const float value = static_cast<float>(i) / (1 << 18);
    lights.insert(lights.end(), {value, value * value * value});
  }
  for (int code = 0; code < 255; ++code) {
    const double srgb = (code + 0.5) / 255;
    const auto edge = static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
    float below = edge, above = edge;
    for (int step = 0; step < 20; ++step) {
      below = std::nextafter(below, 0.f);
      above = std::nextafter(above, 1.f);
      lights.insert(lights.end(), {below, above});
    }
  }
  return lights;
}

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(code))), code);
}

TEST(Srgb, IsTheStandardsCurve) {
  EXPECT_EQ(linear_from_srgb(0), 0);
  EXPECT_EQ(linear_from_srgb(255), 1);
  EXPECT_NEAR(linear_from_srgb(128), 0.21586, 1e-5);
  EXPECT_EQ(srgb_from_linear(0.5f), 188);
}

TEST(Srgb, IsTheNearestCodeValueEverywhere) {
  int rounded_otherwise = 0;
  for (const float light : many_lights()) {
    const double exact = code_by_formula(light);
    // The standard's own constants leave the two halves of its curve a millionth of a code value apart.
    EXPECT_LE(std::abs(srgb_from_linear(light) - exact), 0.5 + 1e-5) << light;
    rounded_otherwise += srgb_from_linear(light) != std::lround(exact);
  }
  EXPECT_LE(rounded_otherwise, 20);
}

TEST(Srgb, ARowIsItsPixels) {
  const std::vector<float> lights = many_lights();
  std::vector<std::uint8_t> row(lights.size());
  srgb_from_linear(lights, row);
  EXPECT_TRUE(std::ranges::equal(row, lights, {}, {}, [](float light) { return srgb_from_linear(light); }));
}

TEST(Srgb, LightOutOfRangeIsLimited) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(srgb_from_linear(-1), 0);
  EXPECT_EQ(srgb_from_linear(-infinity), 0);
  EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(srgb_from_linear(std::nextafter(1.f, 2.f)), 255);
  EXPECT_EQ(srgb_from_linear(7), 255);
  EXPECT_EQ(srgb_from_linear(infinity), 255);
}

TEST(Cielab, IsThatOfKnownColours) {
  struct Known {
    Rgb8 colour;
    Cielab value;
  };
  // Of sRGB's corners, as colour tables have them.
  for (const auto& [colour, value] :
       {Known{{0, 0, 0}, {0, 0, 0}}, Known{{255, 255, 255}, {100, 0, 0}}, Known{{255, 0, 0}, {53.24f, 80.09f, 67.20f}},
        Known{{0, 255, 0}, {87.73f, -86.18f, 83.18f}}, Known{{0, 0, 255}, {32.30f, 79.19f, -107.86f}},
        Known{{119, 119, 119}, {50.03f, 0, 0}}, Known{{5, 5, 5}, {1.37f, 0, 0}}}) {
    const Cielab found = cielab_of(colour);
    EXPECT_NEAR(found.lightness, value.lightness, 0.05f);
    EXPECT_NEAR(found.a, value.a, 0.1f);
    EXPECT_NEAR(found.b, value.b, 0.1f);
  }
}

}  // namespace wheatstone::colour_test
