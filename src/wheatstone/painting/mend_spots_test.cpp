// Paintings of regions show no colour that the photographs have nowhere near.

#include <gtest/gtest.h>

#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

constexpr int width = 160, height = 96;
constexpr Rgb8 dark{40, 40, 40}, light{220, 220, 220}, red{230, 20, 30};

PaintedPair paint_flat(const StereoPair& photographs, const Style& style) {
  return paint(photographs, geometry_from_left(Image<float>(width, height, 0)), style);
}

/// A dark and a light half, and something red.
Image<Rgb8> with_bar(int x, int y, int bar_width, int bar_height) {
  Image<Rgb8> picture(width, height, dark);
  for (int row = 0; row < height; ++row)
    for (int column = width / 2; column < width; ++column) picture(column, row) = light;
  for (int row = y; row < y + bar_height; ++row)
    for (int column = x; column < x + bar_width; ++column) picture(column, row) = red;
  return picture;
}

void expect_right(const PaintedPair& painted, const StereoPair& photographs) {
  EXPECT_LT(measure_wrong_spots(painted.pictures.left, photographs.left).share, 0.002);
  EXPECT_LT(measure_wrong_spots(painted.pictures.right, photographs.right).share, 0.002);
}

TEST(Posterise, IsRightForTheOtherEyeAlsoWhereTheDisparityIsWrong) {
  // The bar is 12 pixels nearer than the disparities say.
  const StereoPair photographs{with_bar(40, 30, 8, 36), with_bar(28, 30, 8, 36)};
  expect_right(paint_flat(photographs, style_by_name("posterise")), photographs);
}

}  // namespace
}  // namespace wheatstone
