#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/disparity_picture.h"
#include "wheatstone/error.h"

namespace wheatstone::display_test {

StereoPair plain_pair(Rgb8 left, Rgb8 right) { return {Image<Rgb8>(4, 2, left), Image<Rgb8>(4, 2, right)}; }

TEST(Anaglyph, GivesDuboisValuesForPrimaries) {
  // Linear 0.437 is sRGB 176, 0.377 is 165, 1.234 clips to 255; negative parts clip to 0.
  EXPECT_EQ(anaglyph(plain_pair({255, 0, 0}, {0, 0, 0}))(0, 0), (Rgb8{177, 0, 0}));
  EXPECT_EQ(anaglyph(plain_pair({0, 0, 0}, {255, 0, 0}))(0, 0), (Rgb8{0, 165, 0}));
  EXPECT_EQ(anaglyph(plain_pair({0, 0, 0}, {0, 0, 255}))(0, 0), (Rgb8{0, 24, 255}));
}

TEST(Anaglyph, ClipsEachEyeBeforeAdding) {
  // The left eye's white would take 0.148 from green if it were not clipped on its own.
  const Rgb8 both = anaglyph(plain_pair({255, 255, 255}, {0, 255, 0}))(0, 0);
  const Rgb8 right_only = anaglyph(plain_pair({0, 0, 0}, {0, 255, 0}))(0, 0);
  EXPECT_EQ(both.g, right_only.g);
}

TEST(SideBySide, PutsTheLeftEyeOnTheLeft) {
  const Image<Rgb8> both = side_by_side(plain_pair({1, 2, 3}, {4, 5, 6}));
  ASSERT_EQ(both.width(), 8);
  EXPECT_EQ(both(3, 1), (Rgb8{1, 2, 3}));
  EXPECT_EQ(both(4, 1), (Rgb8{4, 5, 6}));
}

TEST(Translation, BringsTheChosenDisparityToTheSameColumn) {
  for (const int disparity : {3, 0, -2}) {
    StereoPair pair = plain_pair({}, {});
    pair = {Image<Rgb8>(20, 1), Image<Rgb8>(20, 1)};
    pair.left(10, 0) = {255, 0, 0};
    pair.right(10 - disparity, 0) = {255, 0, 0};
    const StereoPairView moved = set_convergence(pair, static_cast<float>(disparity));
    ASSERT_EQ(moved.left.width(), 20 - std::abs(disparity));
    for (int x = 0; x < moved.left.width(); ++x) EXPECT_EQ(moved.left(x, 0), moved.right(x, 0));
  }
}

TEST(Translation, IsRefusedWhereTheEyesWouldShareNoPicture) {
  const StereoPair pair = plain_pair({}, {});
  const auto width = static_cast<float>(pair.left.width());
  EXPECT_NO_THROW(set_convergence(pair, 0.7f * width));
  for (const float disparity : {0.8f * width, -60000.f, 1e30f, std::nanf("")}) {
    EXPECT_THROW(set_convergence(pair, disparity), Error) << disparity;
    EXPECT_THROW(shifted_views({pair.left, pair.right}, disparity), Error) << disparity;
  }
}

TEST(DisparityPicture, ShowsNearRedFarBlueAndUnknownBlack) {
  Image<float> disparity(3, 1);
  disparity(0, 0) = 1;
  disparity(1, 0) = 9;
  disparity(2, 0) = std::numeric_limits<float>::quiet_NaN();
  Image<float> wide(300, 1);
  for (int x = 0; x < 300; ++x) wide(x, 0) = disparity(x / 100, 0);
  const Image<Rgb8> picture = disparity_picture(wide);
  EXPECT_GT(picture(150, 0).r, picture(150, 0).b);
  EXPECT_GE(picture(50, 0).b, picture(50, 0).r);
  EXPECT_EQ(picture(250, 0), Rgb8{});
}

}  // namespace wheatstone::display_test
