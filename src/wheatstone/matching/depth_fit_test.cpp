#include "wheatstone/matching/depth_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::depth_fit_test {

/// Depth in a unit of its own, of which the cameras make the still life's disparities.
Image<float> depth_of(const Image<float>& disparity, const DepthFit& fit) {
  Image<float> depth(disparity.width(), disparity.height());
  std::ranges::transform(disparity.pixels(), depth.pixels().begin(),
                         [&](float px) { return static_cast<float>(fit.scale / std::max(px - fit.offset_px, 1e-6)); });
  return depth;
}

double rms(const Image<float>& a, const Image<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    sum += (a.pixels()[i] - b.pixels()[i]) * (a.pixels()[i] - b.pixels()[i]);
  return std::sqrt(sum / static_cast<double>(a.pixels().size()));
}

TEST(DepthFit, FindsTheCamerasToATwentiethOfAPixel) {
  for (const int width : {480, 1280}) {
    const SyntheticStill still = make_synthetic_still({.width = width, .height = width / 2, .samples_a_side = 2});
    const auto [least, most] = std::ranges::minmax(still.geometry.left_disparity.pixels());
    for (const DepthFit& cameras : {DepthFit{300, least - 2}, DepthFit{7, least - 0.5 * (most - least)}}) {
      const Image<float> depth = depth_of(still.geometry.left_disparity, cameras);
      const std::optional<DepthFit> found = fit_depth(still.pictures, depth);
      ASSERT_TRUE(found) << width;
      EXPECT_NEAR(found->scale / cameras.scale, 1, 0.01) << width;
      EXPECT_LT(rms(disparity_of_depth(depth, *found), still.geometry.left_disparity), 0.05) << width;
    }
  }
}

TEST(DepthFit, IsNoneWhereNothingTellsIt) {
  const Image<Rgb8> grey(64, 48, {90, 90, 90});
  EXPECT_FALSE(fit_depth({grey, grey}, Image<float>(64, 48, 3)));
  const SyntheticStill still = make_synthetic_still({.width = 160, .height = 90, .samples_a_side = 1});
  EXPECT_FALSE(fit_depth(still.pictures, Image<float>(160, 90, 3))) << "all equally far";
}

TEST(DepthFit, OfWhatHasNoDepthIsUnknown) {
  Image<float> depth(3, 1);
  depth(0, 0) = std::numeric_limits<float>::infinity();
  depth(1, 0) = 0;
  depth(2, 0) = 4;
  const Image<float> disparity = disparity_of_depth(depth, {8, -1});
  EXPECT_EQ(disparity(0, 0), -1);
  EXPECT_TRUE(std::isnan(disparity(1, 0)));
  EXPECT_EQ(disparity(2, 0), 1);
}

TEST(DepthFit, AgreesWithTheOtherViewWhereBothSeeTheSame) {
  const SyntheticStill still = make_synthetic_still({.width = 320, .height = 180, .samples_a_side = 1});
  const StereoGeometry& truth = still.geometry;
  EXPECT_GT(agreeing_share(truth.left_disparity, truth.right_disparity), 0.85);
  Image<float> nearer = truth.right_disparity;
  for (float& px : nearer.pixels()) px += 4;
  EXPECT_LT(agreeing_share(truth.left_disparity, nearer), 0.2);
}

}  // namespace wheatstone::depth_fit_test
