#include "wheatstone/stereo/single_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenes/still_life.h"
#include "throws_error.h"
#include "wheatstone/measures/consistency.h"

namespace wheatstone::single_view_test {

constexpr int width = 100, height = 6;
constexpr Rgb8 post_colour{200, 30, 30}, mixed{120, 60, 60};

/// A colour for every column of the wall.
Rgb8 wall(int x) { return {static_cast<std::uint8_t>(2 * x), 0, 100}; }

/// A wall of disparity 2 with a post of disparity 12 before it, columns 40 to 59, with a rim of mixed colours.
Image<Rgb8> post_picture() {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture(x, y) = x >= 40 && x < 60 ? post_colour : x == 39 || x == 60 ? mixed : wall(x);
  return picture;
}
Image<float> post_disparity() {
  Image<float> disparity(width, height, 2);
  for (int y = 0; y < height; ++y)
    for (int x = 40; x < 60; ++x) disparity(x, y) = 12;
  return disparity;
}

TEST(SingleView, ContinuesTheFartherSurfaceWhereItIsUncovered) {
  const MadePair made = make_pair_from_single_view(post_picture(), post_disparity());
  EXPECT_EQ(made.pictures.left, post_picture());
  for (int x = 2; x < width - 2; ++x) {
    const Rgb8 colour = made.pictures.right(x, 3);
    // The post stands at columns 28 to 47 of the right view, and bares the wall behind it to column 57.
    if (x >= 28 && x < 48) {
      EXPECT_EQ(colour, post_colour) << x;
      EXPECT_EQ(made.geometry.right_disparity(x, 3), 12) << x;
      continue;
    }
    EXPECT_EQ(made.geometry.right_disparity(x, 3), 2) << x;
    EXPECT_NE(colour, post_colour) << x;
    // The mirror stands at the first column of the wall itself: 61 of the left view, 59 of the right one.
    EXPECT_EQ(colour, wall(x < 48 || x >= 59 ? x + 2 : 61 + (58 - x))) << x;
  }
}

TEST(SingleView, FillsUnknownDisparitiesAndRefusesNothingButThem) {
  Image<float> disparity = post_disparity();
  disparity(10, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(make_pair_from_single_view(post_picture(), disparity).geometry.left_disparity(10, 2), 2);
  std::ranges::fill(disparity.pixels(), std::numeric_limits<float>::quiet_NaN());
  expect_error(ErrorKind::bad_input, "unknown everywhere",
               [&] { make_pair_from_single_view(post_picture(), disparity); });
  expect_error(ErrorKind::bad_input, "10x6", [&] { make_pair_from_single_view(post_picture(), Image<float>(10, 6)); });
}

TEST(SingleView, IsAsConsistentAsThePairThatCamerasTake) {
  const SyntheticStill& still = still_life(320, 240);
  const MadePair made = make_pair_from_single_view(still.pictures.left, still.geometry.left_disparity);
  const double ours = measure_left_right_difference(made.pictures, still.geometry.left_disparity).mean_absolute;
  const double cameras = measure_left_right_difference(still.pictures, still.geometry.left_disparity).mean_absolute;
  testing::Test::RecordProperty("of_the_cameras", std::to_string(ours / cameras));
  EXPECT_LE(ours, 1.3 * cameras);
}

/// Mean difference of two pictures where `mask` is `value`.
double difference_where(const Image<Rgb8>& a, const Image<Rgb8>& b, const Image<std::uint8_t>& mask, bool set) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    if ((mask.pixels()[i] != 0) != set) continue;
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
    count += 3;
  }
  return sum / static_cast<double>(count);
}

TEST(SingleView, MakesTheRightPictureThatACameraTakes) {
  const SyntheticStill& still = still_life(320, 240);
  const MadePair made = make_pair_from_single_view(still.pictures.left, still.geometry.left_disparity);
  const Image<std::uint8_t>& hidden = still.geometry.right_occlusion;
  const double seen_by_both = difference_where(made.pictures.right, still.pictures.right, hidden, false);
  const double uncovered = difference_where(made.pictures.right, still.pictures.right, hidden, true);
  const double moved_nothing = difference_where(still.pictures.left, still.pictures.right, hidden, false);
  testing::Test::RecordProperty("seen_by_both", std::to_string(seen_by_both));
  testing::Test::RecordProperty("uncovered", std::to_string(uncovered));
  testing::Test::RecordProperty("moved_nothing", std::to_string(moved_nothing));
  EXPECT_LE(seen_by_both, 0.25 * moved_nothing);
  EXPECT_LE(uncovered, moved_nothing);
}

}  // namespace wheatstone::single_view_test
