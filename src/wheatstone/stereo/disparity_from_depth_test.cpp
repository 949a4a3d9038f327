#include "wheatstone/stereo/disparity_from_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "throws_error.h"

namespace wheatstone::disparity_from_depth_test {

constexpr int width = 200, height = 100;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr Rgb8 dark{20, 20, 20}, bright{230, 230, 230};

/// Bright where the near half is, from this column on.
Image<Rgb8> halves(int column) {
  Image<Rgb8> picture(width, height, dark);
  for (int y = 0; y < height; ++y)
    for (int x = column; x < width; ++x) picture(x, y) = bright;
  return picture;
}

/// `far` on the left, `near` from this column on.
Image<float> step(float far, float near, int column = width / 2) {
  Image<float> depth(width, height, far);
  for (int y = 0; y < height; ++y)
    for (int x = column; x < width; ++x) depth(x, y) = near;
  return depth;
}

TEST(DisparityFromDepth, SpansTheStrengthOfTheWidth) {
  const Image<Rgb8> picture = halves(width / 2);
  const Image<float> disparity = disparity_from_depth(step(40, 200), picture);
  EXPECT_FLOAT_EQ(disparity(10, 10), 0);
  EXPECT_FLOAT_EQ(disparity(width - 10, 10), 0.03f * width);
  EXPECT_FLOAT_EQ(disparity_from_depth(step(40, 200), picture, {.strength = 0.1f})(width - 10, 10), 0.1f * width);
  for (const float strength : {0.f, 1.f, unknown})
    expect_error(ErrorKind::wrong_usage, "strength",
                 [&] { disparity_from_depth(step(1, 2), picture, {.strength = strength}); });
}

TEST(DisparityFromDepth, OfALengthIsItsInverse) {
  // 1 m, 2 m and 4 m away: the middle has a third of the nearest one's disparity.
  Image<float> metres = step(4, 1, 150);
  for (int y = 0; y < height; ++y)
    for (int x = 50; x < 150; ++x) metres(x, y) = 2;
  metres(20, 20) = 0;
  metres(30, 20) = -5;
  const Image<float> disparity = disparity_from_depth(metres, Image<Rgb8>(width, height), {.kind = DepthKind::metric});
  EXPECT_FLOAT_EQ(disparity(10, 10), 0);
  EXPECT_NEAR(disparity(100, 10), 2, 1e-4);
  EXPECT_FLOAT_EQ(disparity(180, 10), 6);
  EXPECT_FLOAT_EQ(disparity(20, 20), 0) << "0 is unknown and takes its neighbours'";
  EXPECT_FLOAT_EQ(disparity(30, 20), 0);
}

TEST(DisparityFromDepth, TakesUnknownPixelsFromTheFartherSide) {
  Image<float> depth = step(1, 2);
  depth(width / 2, 7) = depth(width / 2 + 1, 7) = unknown;
  depth(3, 3) = std::numeric_limits<float>::infinity();
  const Image<float> disparity = disparity_from_depth(depth, halves(width / 2));
  EXPECT_FLOAT_EQ(disparity(width / 2 + 1, 7), 0);
  EXPECT_FLOAT_EQ(disparity(3, 3), 0);
  for (const float d : disparity.pixels()) EXPECT_TRUE(std::isfinite(d));
}

TEST(DisparityFromDepth, KeepsAnEdgeSharpWhereDepthIsOfAnotherSize) {
  // Of a quarter of the size, and with its edge two pixels of the picture off that of the colours.
  Image<float> small(width / 4, height / 4, 10);
  for (int y = 0; y < small.height(); ++y)
    for (int x = small.width() / 2; x < small.width(); ++x) small(x, y) = 90;
  const int edge = width / 2 + 1;
  const Image<float> disparity = disparity_from_depth(small, halves(edge), {.strength = 0.1f});
  for (int x = 0; x < width; ++x) EXPECT_FLOAT_EQ(disparity(x, 50), x < edge ? 0 : 0.1f * width) << x;
}

TEST(DisparityFromDepth, InterpolatesWithinASurface) {
  Image<float> small(width / 4, height / 4);
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x) small(x, y) = static_cast<float>(x);
  const Image<float> disparity = disparity_from_depth(small, Image<Rgb8>(width, height));
  for (int x = 1; x < width; ++x) {
    EXPECT_GE(disparity(x, 50), disparity(x - 1, 50));
    EXPECT_LE(disparity(x, 50) - disparity(x - 1, 50), 0.04f) << x;
  }
}

TEST(DisparityFromDepth, MakesAStepOfARampAcrossAnEdge) {
  // Three pixels of a ramp, as networks leave them.
  Image<float> depth = step(0, 100, 102);
  for (int y = 0; y < height; ++y)
    for (int x = 99; x < 102; ++x) depth(x, y) = static_cast<float>(x - 98) * 100 / 4;
  Image<Rgb8> picture(width, height);
  const Image<float> disparity = disparity_from_depth(depth, picture, {.strength = 0.1f});
  for (int x = 0; x < width; ++x) {
    EXPECT_FLOAT_EQ(disparity(x, 50), x < 100 ? 0 : 20) << x;
  }
}

TEST(DisparityFromDepth, IsZeroWhereTheDepthIsTheSameEverywhere) {
  EXPECT_EQ(inverse_depth_range(step(7, 7), DepthKind::inverse), std::nullopt);
  EXPECT_EQ(disparity_from_depth(step(7, 7), Image<Rgb8>(width, height)), Image<float>(width, height));
  EXPECT_EQ(disparity_from_depth(step(7, unknown), Image<Rgb8>(2 * width, 2 * height)),
            Image<float>(2 * width, 2 * height));
}

TEST(DisparityFromDepth, RefusesWhatDoesNotFitOrIsUnknown) {
  const Image<Rgb8> picture(width, height);
  expect_error(ErrorKind::bad_input, "unknown everywhere",
               [&] { disparity_from_depth(step(unknown, unknown), picture); });
  expect_error(ErrorKind::bad_input, "unknown everywhere",
               [&] { disparity_from_depth(step(0, -3), picture, {.kind = DepthKind::metric}); });
  expect_error(ErrorKind::bad_input, "100x100 pixels, expected the shape of the picture, 200x100",
               [&] { disparity_from_depth(Image<float>(100, 100, 1), picture); });
  // One pixel of 200 is a difference that rounding makes.
  EXPECT_NO_THROW(disparity_from_depth(step(1, 2), Image<Rgb8>(401, 200)));
}

}  // namespace wheatstone::disparity_from_depth_test
