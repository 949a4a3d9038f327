#include "wheatstone/marks/residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/random.h"

namespace wheatstone::residual_test {

/// The definition, pixel by pixel.
bool is_residual(Rgb8 colour, const Image<Rgb8>& target, int x, int y) {
  for (int row = 0; row < target.height(); ++row)
    for (int column = 0; column < target.width(); ++column)
      if (std::hypot(column - x, row - y) <= nearness_px(target.width()) && is_like(target(column, row), colour))
        return false;
  return true;
}

TEST(Residual, IsThatOfTheDefinitionUpToTheBorders) {
  constexpr int height = 9;
  for (const int width : {1, 33, 161, 401}) {
    Image<Rgb8> drawn(width, height), target(width, height);
    std::uint64_t number = 0;
    const auto level = [&] { return static_cast<std::uint8_t>(hash_keys({++number}) % 140); };
    for (Image<Rgb8>* picture : {&drawn, &target})
      for (Rgb8& pixel : picture->pixels()) pixel = {level(), level(), level()};
    const Image<std::uint8_t> wrong = residual(drawn, target);
    const NearColours near(target);
    int count = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(wrong(x, y) != 0, is_residual(drawn(x, y), target, x, y)) << x << ' ' << y;
        ASSERT_EQ(wrong(x, y) == 0, near.has(drawn(x, y), x, y)) << x << ' ' << y;
        count += wrong(x, y) != 0 ? 1 : 0;
      }
    }
    EXPECT_TRUE(width == 1 || (count > 0 && count < width * height)) << width;
  }
}

}  // namespace wheatstone::residual_test
