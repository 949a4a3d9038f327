#include "wheatstone/measures/wrong_spots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "throws_error.h"
#include "wheatstone/random.h"

namespace wheatstone::wrong_spots_test {

constexpr Rgb8 grey{100, 100, 100}, white{255, 255, 255};

Image<Rgb8> with_square(int x, int y, int side, Rgb8 colour) {
  Image<Rgb8> picture(640, 100, grey);
  for (int row = y; row < y + side; ++row)
    for (int column = x; column < x + side; ++column) picture(column, row) = colour;
  return picture;
}

TEST(WrongSpots, AreNoneInThePhotographItself) {
  const Image<Rgb8> photograph = with_square(300, 40, 10, white);
  EXPECT_EQ(measure_wrong_spots(photograph, photograph).spots_per_100000_px, 0);
}

TEST(WrongSpots, AreColoursThatAreNowhereNear) {
  const Image<Rgb8> photograph(640, 100, grey);
  const WrongSpots spots = measure_wrong_spots(with_square(300, 40, 10, white), photograph);
  EXPECT_DOUBLE_EQ(spots.spots_per_100000_px, 1e5 / 64000);
  EXPECT_DOUBLE_EQ(spots.share, 100.0 / 64000);
}

TEST(WrongSpots, AreNotWhatOnlyMovedAFewPixels) {
  const Image<Rgb8> photograph = with_square(300, 40, 10, white);
  EXPECT_EQ(measure_wrong_spots(with_square(304, 40, 10, white), photograph).share, 0);
  EXPECT_GT(measure_wrong_spots(with_square(305, 40, 10, white), photograph).share, 0);
}

TEST(WrongSpots, CountFromFourPixelsOnAndByDistance) {
  const Image<Rgb8> photograph(640, 100, grey);
  EXPECT_EQ(measure_wrong_spots(with_square(300, 40, 1, white), photograph).share, 0);
  EXPECT_GT(measure_wrong_spots(with_square(300, 40, 2, white), photograph).share, 0);
  EXPECT_EQ(measure_wrong_spots(with_square(300, 40, 9, {134, 134, 134}), photograph).share, 0) << "58.9 away";
  EXPECT_GT(measure_wrong_spots(with_square(300, 40, 9, {135, 135, 135}), photograph).share, 0) << "60.6 away";
}

TEST(WrongSpots, CountInOklabWhereColoursLookDifferent) {
  constexpr auto oklab = ColourDistance::oklab;
  const Image<Rgb8> photograph(640, 100, grey);
  EXPECT_EQ(measure_wrong_spots(photograph, photograph, oklab).share, 0);
  EXPECT_DOUBLE_EQ(measure_wrong_spots(with_square(300, 40, 10, white), photograph, oklab).share, 100.0 / 64000);
  EXPECT_EQ(measure_wrong_spots(with_square(300, 40, 9, {132, 132, 132}), photograph, oklab).share, 0) << "0.106";
  EXPECT_GT(measure_wrong_spots(with_square(300, 40, 9, {134, 134, 134}), photograph, oklab).share, 0) << "0.113";
  // A little blue in a yellow is 70 away in RGB, and hardly seen.
  const Image<Rgb8> yellow(640, 100, {220, 220, 0}), other(640, 100, {220, 220, 70});
  EXPECT_EQ(measure_wrong_spots(other, yellow).share, 1);
  EXPECT_EQ(measure_wrong_spots(other, yellow, oklab).share, 0);
}

TEST(WrongSpots, OfAPairAreThoseOfBothEyes) {
  const Image<Rgb8> photograph(640, 100, grey);
  const StereoPair painted{with_square(300, 40, 10, white), photograph}, photographs{photograph, photograph};
  EXPECT_DOUBLE_EQ(measure_wrong_spots(painted, photographs).spots_per_100000_px, 1e5 / 128000);
}

/// As it is told, pixel by pixel.
bool is_wrong_by_definition(Rgb8 colour, const Image<Rgb8>& photograph, int x, int y) {
  const double radius_px = 4.0 * photograph.width() / 640;
  for (int row = 0; row < photograph.height(); ++row) {
    for (int column = 0; column < photograph.width(); ++column) {
      if (std::hypot(column - x, row - y) > radius_px) continue;
      const Rgb8 there = photograph(column, row);
      if (std::hypot(there.r - colour.r, there.g - colour.g, there.b - colour.b) <= 60) return false;
    }
  }
  return true;
}

TEST(WrongPixels, AreThoseOfTheDefinitionUpToTheBorders) {
  constexpr int height = 9;
  for (const int width : {1, 33, 161, 401}) {
    Image<Rgb8> painted(width, height), photograph(width, height);
    std::uint64_t number = 0;
    const auto level = [&] { return static_cast<std::uint8_t>(hash_keys({++number}) % 140); };
    for (Image<Rgb8>* picture : {&painted, &photograph})
      for (Rgb8& pixel : picture->pixels()) pixel = {level(), level(), level()};
    const Image<std::uint8_t> wrong = wrong_pixels(painted, photograph);
    int count = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(wrong(x, y) != 0, is_wrong_by_definition(painted(x, y), photograph, x, y)) << x << ' ' << y;
        count += wrong(x, y) != 0 ? 1 : 0;
      }
    }
    EXPECT_TRUE(width == 1 || (count > 0 && count < width * height)) << width;
  }
}

TEST(WrongSpots, NeedOneSize) {
  expect_error(ErrorKind::bad_input, "expected the photograph's 10x10",
               [] { measure_wrong_spots(Image<Rgb8>(10, 9), Image<Rgb8>(10, 10)); });
}

}  // namespace wheatstone::wrong_spots_test
