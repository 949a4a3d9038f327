#include "wheatstone/depth/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wheatstone::convergence_test {

TEST(Depth, IsInverselyProportionalToDisparity) {
  EXPECT_FLOAT_EQ(depth_from_disparity(8, 400), 50);
  EXPECT_TRUE(std::isinf(depth_from_disparity(0, 400)));
  EXPECT_TRUE(std::isnan(depth_from_disparity(-1, 400))) << "behind infinity there is no depth";
}

TEST(DisparityPercentile, OfALargePictureIsThatOfAllItsPixels) {
  Image<float> ramp(2900, 1500);
  for (int y = 0; y < ramp.height(); ++y)
    for (int x = 0; x < ramp.width(); ++x) ramp(x, y) = static_cast<float>(x) + 0.1f * static_cast<float>(y);
  EXPECT_NEAR(disparity_percentile(ramp, 0.5), 1524.5, 2);
  EXPECT_NEAR(depth_ends(ramp).farthest_px, 132, 2);
  EXPECT_NEAR(depth_ends(ramp).nearest_px, 2917, 2);
}

TEST(DepthEnds, OfAStripAreKnown) {
  Image<float> strip(3'000'000, 1);
  for (int x = 0; x < strip.width(); ++x) strip(x, 0) = static_cast<float>(x % 100);
  EXPECT_NEAR(depth_ends(strip).farthest_px, 2, 1);
  EXPECT_NEAR(depth_ends(KnownRuns(strip)).nearest_px, 97, 1);
  EXPECT_TRUE(std::isnan(depth_ends(KnownRuns()).nearest_px));
}

TEST(DisparityPercentile, PassesOverUnknownsAndOutliers) {
  Image<float> disparity(1000, 1);
  for (int x = 0; x < 1000; ++x) disparity(x, 0) = static_cast<float>(x % 100);
  disparity(0, 0) = 5000;
  disparity(1, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FLOAT_EQ(disparity_percentile(disparity, 0.995), 99);
  EXPECT_NEAR(disparity_percentile(disparity, 0.5), 50, 1);
  EXPECT_TRUE(std::isnan(disparity_percentile(Image<float>(3, 3, std::numeric_limits<float>::infinity()), 0.5)));
}

}  // namespace wheatstone::convergence_test
