#include "wheatstone/stereo/retouch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wheatstone::retouch_test {

constexpr int width = 80, height = 60;

/// A blue sky with a gradient above a dark wood, whose rim slopes.
Image<Rgb8> sky_above_wood() {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture(x, y) = y < 30 + x / 8 ? Rgb8{static_cast<std::uint8_t>(90 + y / 2), 140, 220} : Rgb8{30, 60, 30};
  return picture;
}

TEST(Retouch, ShiftsWhatLiesUnderTheBrushAndNothingBesideIt) {
  Image<float> disparity(width, height, 10);
  retouch_disparity(std::vector<Touch>{{Retouch::shift, 40, 30, 12, 3}}, sky_above_wood(), disparity);
  EXPECT_FLOAT_EQ(disparity(40, 30), 13);
  EXPECT_FLOAT_EQ(disparity(44, 30), 13);
  EXPECT_GT(disparity(48, 30), 10);
  EXPECT_LT(disparity(48, 30), 13);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double distance = std::hypot(x + 0.5 - 40, y + 0.5 - 30);
      if (distance >= 12) {
        ASSERT_EQ(disparity(x, y), 10) << x << ' ' << y;
      }
    }
  }
}

TEST(Retouch, SetsADisparityWhateverWasThere) {
  Image<float> disparity(width, height, 10);
  disparity(40, 30) = -50;
  retouch_disparity(std::vector<Touch>{{Retouch::set, 40.5f, 30.5f, 10, 4}}, sky_above_wood(), disparity);
  EXPECT_FLOAT_EQ(disparity(40, 30), 4);
  EXPECT_FLOAT_EQ(disparity(42, 33), 4);
}

TEST(Retouch, SmoothsAStep) {
  Image<float> disparity(width, height, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 40; x < width; ++x) disparity(x, y) = 8;
  retouch_disparity(std::vector<Touch>{{Retouch::smooth, 40, 30, 20, 4}}, sky_above_wood(), disparity);
  EXPECT_LT(disparity(40, 30) - disparity(39, 30), 1.5f);
  EXPECT_EQ(disparity(40, 5) - disparity(39, 5), 8);
  EXPECT_NEAR(disparity(39, 30) + disparity(40, 30), 8, 0.01f);
}

/// A triangle as a hand goes around it.
std::vector<Touch> around(Retouch kind, float amount) {
  return {{.kind = kind, .x = 10, .y = 10, .amount = amount},
          {.kind = kind, .x = 50, .y = 10, .amount = amount, .goes_on = true},
          {.kind = kind, .x = 10, .y = 50, .amount = amount, .goes_on = true}};
}

TEST(Retouch, ShiftsTheAreaThatALassoGoesAround) {
  Image<float> disparity(width, height, 10);
  disparity(20, 20) = 12;
  retouch_disparity(around(Retouch::shift_area, 3), sky_above_wood(), disparity);
  EXPECT_EQ(disparity(15, 15), 13);
  EXPECT_EQ(disparity(20, 20), 15);
  EXPECT_EQ(disparity(40, 40), 10);
  EXPECT_EQ(disparity(8, 20), 10);
}

TEST(Retouch, ALassoIsDoneOnceAndTheNextBeginsAnew) {
  Image<float> disparity(width, height, 10);
  std::vector<Touch> touches = around(Retouch::shift_area, 3);
  for (const Touch& touch : around(Retouch::set_area, 1)) touches.push_back(touch);
  for (const Touch& touch : around(Retouch::shift_area, 2)) touches.push_back(touch);
  touches.push_back({.kind = Retouch::shift_area, .x = 60, .y = 50, .amount = 7});  // goes around nothing yet
  retouch_disparity(touches, sky_above_wood(), disparity);
  EXPECT_EQ(disparity(15, 15), 3);
  EXPECT_EQ(disparity(60, 50), 10);
  EXPECT_EQ(disparity(40, 40), 10);
}

TEST(Retouch, FillsTheSkyToItsRim) {
  const Image<Rgb8> picture = sky_above_wood();
  Image<float> disparity(width, height, 10);
  retouch_disparity(std::vector<Touch>{{Retouch::fill, 5, 5, 0, -2}}, picture, disparity);
  int wrong = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) wrong += disparity(x, y) == (picture(x, y).b > 100 ? -2 : 10) ? 0 : 1;
  EXPECT_LE(wrong, width / 4);
}

TEST(Retouch, ChangesTheDetailMapByTouchesOfDetailAlone) {
  Image<std::uint8_t> detail(width, height, 128);
  Image<float> disparity(width, height, 10);
  const std::vector<Touch> touches{
      {Retouch::detail, 20, 20, 8, 100}, {Retouch::detail, 60, 40, 8, -200}, {Retouch::shift, 40, 30, 8, 3}};
  retouch_detail(touches, detail);
  EXPECT_EQ(detail(20, 20), 228);
  EXPECT_EQ(detail(60, 40), 0);
  EXPECT_EQ(detail(40, 30), 128);
  retouch_disparity(touches, sky_above_wood(), disparity);
  EXPECT_EQ(disparity(20, 20), 10);
  EXPECT_EQ(disparity(40, 30), 13);
}

TEST(Retouch, DoesNothingBesideThePicture) {
  const Image<float> before(width, height, 10);
  Image<float> disparity = before;
  std::vector<Touch> touches;
  for (const Retouch kind : {Retouch::shift, Retouch::smooth, Retouch::set, Retouch::fill})
    for (const float x : {-1e9f, -60.f, 200.f, 1e9f}) touches.push_back({kind, x, 30, 20, 3});
  retouch_disparity(touches, sky_above_wood(), disparity);
  EXPECT_EQ(disparity, before);
}

}  // namespace wheatstone::retouch_test
