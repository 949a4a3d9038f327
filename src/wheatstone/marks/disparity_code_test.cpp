#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/marks/disparity_code.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone::disparity_code_test {

constexpr int width = 61, height = 17;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Near and far, before and behind the display, with gaps, in whole steps.
KnownRuns disparities() {
  Image<float> made(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      made(x, y) = (x + y) % 7 == 0 ? unknown : static_cast<float>(x * y - 300) * (x > 30 ? 8 : -0.25f);
  made(0, 0) = 4e6f;
  made(1, 0) = -4e6f;
  for (int x = 0; x < width; ++x) made(x, 5) = unknown;
  return KnownRuns(made);
}

TEST(DisparityCode, BringsWholeStepsBackEqual) {
  const KnownRuns made = disparities();
  const auto back = decode_disparities(encode_disparities(made), width, height);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(*back, made);
  EXPECT_TRUE(std::isnan((*back)(3, 5)));
}

TEST(DisparityCode, RoundsToSteps) {
  Image<float> fine(3, 1);
  fine(0, 0) = 1.04f;
  fine(1, 0) = -1.04f;
  fine(2, 0) = 7.96875f;
  const auto back = decode_disparities(encode_disparities(KnownRuns(fine)), 3, 1);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ((*back)(0, 0), 1.0625f);
  EXPECT_EQ((*back)(1, 0), -1.0625f);
  EXPECT_NEAR((*back)(2, 0), 7.96875f, 0.5f / disparity_steps);
}

TEST(DisparityCode, TakesAFewBitsForAPixelOfASmoothSurface) {
  Image<float> slope(320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) slope(x, y) = std::round(0.1f * static_cast<float>(x + y) * 16) / 16;
  EXPECT_LT(encode_disparities(KnownRuns(slope)).size(), slope.pixels().size() / 8);
}

TEST(DisparityCode, RefusesWhatIsNotExactlyASurfaceOfItsSize) {
  const std::vector<std::uint8_t> good = encode_disparities(disparities());
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(decode_disparities(std::span(good).first(size), width, height)) << size;
  std::vector<std::uint8_t> longer = good;
  longer.push_back(0);
  EXPECT_FALSE(decode_disparities(longer, width, height));
  EXPECT_FALSE(decode_disparities(good, width + 1, height));
  EXPECT_FALSE(decode_disparities(good, width, height - 1));
  // Not even the memory is asked for.
  EXPECT_FALSE(decode_disparities(good, 65535, 65535));
}

TEST(DisparityCode, NeverBelievesAFlippedByte) {
  const std::vector<std::uint8_t> good = encode_disparities(disparities());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<std::uint8_t> bad = good;
    bad[i] ^= 0x10;
    const auto back = decode_disparities(bad, width, height);
    EXPECT_TRUE(!back || *back == disparities()) << i;
  }
}

}  // namespace wheatstone::disparity_code_test
