#include "wheatstone/stereo/framed_pair_internal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "throws_error.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::framed_pair_test {

/// A picture whose red is its column.
StereoPair columns(int width, int height, int disparity) {
  StereoPair pair{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      pair.left(x, y) = {static_cast<std::uint8_t>(x), 0, 0};
      pair.right(x, y) = {static_cast<std::uint8_t>(std::min(x + disparity, 255)), 0, 0};
    }
  return pair;
}

StereoGeometry flat(int width, int height, float disparity) {
  return {Image<float>(width, height, disparity), Image<float>(width, height, disparity),
          Image<std::uint8_t>(width, height), Image<std::uint8_t>(width, height)};
}

TEST(FramedPair, TheWantedDisparityComesToLieOnTheScreen) {
  for (const int plane : {12, -9}) {
    const FramedPair pair = framed(columns(120, 40, plane), flat(120, 40, static_cast<float>(plane)),
                                   {.zero_parallax_px = static_cast<float>(plane), .width = 60, .height = 40});
    EXPECT_EQ(pair.photographs.left.width(), 60);
    EXPECT_EQ(pair.photographs.left.height(), 40);
    EXPECT_EQ(pair.scale, 1);
    for (int x = 0; x < 60; ++x) {
      EXPECT_EQ(pair.photographs.left(x, 20).r, pair.photographs.right(x, 20).r) << x;
      EXPECT_EQ(pair.geometry.left_disparity(x, 20), 0);
    }
  }
}

TEST(FramedPair, DisparityGrowsWithThePicture) {
  const FramedPair pair =
      framed(columns(120, 40, 20), flat(120, 40, 20), {.zero_parallax_px = 14, .width = 60, .height = 80});
  EXPECT_EQ(pair.scale, 2);
  EXPECT_EQ(pair.geometry.left_disparity(30, 40), 12);
}

TEST(FramedPair, MarginIsWhatThereIsRoomFor) {
  const ScreenFrame frame{.zero_parallax_px = 0, .width = 60, .height = 40, .margin_px = 20};
  EXPECT_EQ(framed(columns(120, 40, 0), flat(120, 40, 0), frame).margin_px, 20);
  EXPECT_EQ(framed(columns(80, 40, 0), flat(80, 40, 0), frame).margin_px, 10);
  const FramedPair none = framed(columns(60, 60, 0), flat(60, 60, 0), frame);
  EXPECT_EQ(none.margin_px, 0);
  EXPECT_EQ(none.photographs.left.width(), 60);
}

TEST(FramedPair, RefusesWhatLeavesNothing) {
  expect_error(ErrorKind::wrong_usage, "shifted by 30",
               [] { framed(columns(30, 20, 0), flat(30, 20, 0), {.zero_parallax_px = 30}); });
}

}  // namespace wheatstone::framed_pair_test
