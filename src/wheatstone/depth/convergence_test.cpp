#include "wheatstone/depth/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wheatstone {
namespace {

TEST(Depth, IsInverselyProportionalToDisparity) {
  EXPECT_FLOAT_EQ(depth_from_disparity(8, 400), 50);
  EXPECT_TRUE(std::isinf(depth_from_disparity(0, 400)));
  EXPECT_TRUE(std::isnan(depth_from_disparity(-1, 400))) << "behind infinity there is no depth";
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

}  // namespace
}  // namespace wheatstone
