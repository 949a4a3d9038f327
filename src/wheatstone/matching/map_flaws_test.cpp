#include "wheatstone/matching/map_flaws_internal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/still_life.h"
#include "wheatstone/matching/match.h"

namespace wheatstone::map_flaws_test {

TEST(MapFlaws, CountStreaks) {
  Image<float> slope(1280, 720);
  for (int y = 0; y < slope.height(); ++y)
    for (int x = 0; x < slope.width(); ++x) slope(x, y) = 10 + 0.05f * static_cast<float>(y);
  EXPECT_EQ(streak_share(slope), 0);
  // Every twelfth pair of rows is off over half of the width: a pair of rows is one of the copy's.
  for (int y = 0; y < slope.height(); ++y)
    for (int x = 0; x < slope.width() / 2; ++x)
      if (y / 2 % 12 == 0) slope(x, y) += 20;
  EXPECT_NEAR(streak_share(slope), 0.5 / 12, 0.003);
}

/// A plain picture; on its right half, where there is an edge, black.
Image<Rgb8> plain_picture(int width, int height) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = x < width / 2 ? Rgb8{200, 200, 200} : Rgb8{0, 0, 0};
  return picture;
}

/// A slope that has a spot of another disparity about a column.
Image<float> slope_with_spot(int width, int height, int spot_x) {
  Image<float> slope(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int dx = x - spot_x, dy = y - height / 2;
      slope(x, y) = 10 + 0.05f * static_cast<float>(y) + (dx * dx + dy * dy < 100 ? 10.f : 0);
    }
  return slope;
}

TEST(MapFlaws, CountPatchesOnPlainGround) {
  const Image<Rgb8> picture = plain_picture(800, 600);
  EXPECT_EQ(patch_share(slope_with_spot(800, 600, -100), picture), 0);
  EXPECT_NEAR(patch_share(slope_with_spot(800, 600, 200), picture), 314. / (800 * 600), 20. / (800 * 600));
}

TEST(MapFlaws, CountNoPatchesAtAnEdgeOfThePhotograph) {
  EXPECT_LT(patch_share(slope_with_spot(800, 600, 400), plain_picture(800, 600)), 0.7 * 314 / (800 * 600));
}

TEST(MapFlaws, AreAsFewInAMatchedMapAsInTheTrueOne) {
  const SyntheticStill& still = still_life(480, 360);
  const double truth = patch_share(still.geometry.left_disparity, still.pictures.left);
  const double matched = patch_share(match(still.pictures).geometry.left_disparity, still.pictures.left);
  RecordProperty("shares", fmt::format("true {:.4f}, matched {:.4f}", truth, matched));
  EXPECT_LT(matched, truth + 0.001);
}

}  // namespace wheatstone::map_flaws_test
