// Paint at a surface's outline, in views to the side.

#include "wheatstone/strokes/outline_disparity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wheatstone::outline_disparity_test {

constexpr int width = 120, height = 40, left_end = 30, right_end = 90;
constexpr float wall = 4, threshold_px = 3;

/// A pillar before a wall: half an ellipse, 3 pixels of disparity deep.
Image<float> pillar() {
  Image<float> disparity(width, height, wall);
  for (int y = 0; y < height; ++y) {
    for (int x = left_end; x < right_end; ++x) {
      const float aside = (static_cast<float>(x) + 0.5f - 60) / 30;
      disparity(x, y) = 20 + 3 * std::sqrt(1 - aside * aside);
    }
  }
  return disparity;
}

/// Where the pillar's pixels end on one side (−1 or 1), seen from `views` eye separations to the right.
float outline(const Image<float>& disparity, int side, float views) {
  float end = 0;
  for (int x = left_end; x < right_end; ++x) {
    const float place = static_cast<float>(x) + 0.5f * static_cast<float>(1 + side) - views * disparity(x, 20);
    end = x == left_end ? place : side < 0 ? std::min(end, place) : std::max(end, place);
  }
  return end;
}

TEST(DisparityWithinOutline, KeepsPaintWithinTheOutlineOfViewsToTheSide) {
  const Image<float> disparity = pillar();
  const StrokeGround ground{disparity, threshold_px, {2, 3}};
  const float leftmost = outline(disparity, -1, 3), rightmost = outline(disparity, 1, -2);
  int own_spills = 0;
  for (const float radius : {2.f, 4.f, 8.f}) {
    for (int x = left_end; x < right_end; ++x) {
      const ControlPoint point{static_cast<float>(x) + 0.5f, 20.5f, disparity(x, 20)};
      if (point.x - radius < left_end || point.x + radius > right_end) continue;
      const float limited = disparity_within_outline(ground, point, radius);
      EXPECT_LE(limited, point.disparity);
      EXPECT_GE(limited, point.disparity - threshold_px);
      // The pixel at the outline is as wide as a pixel.
      EXPECT_GE(point.x - radius - 3 * limited, leftmost - 0.5f) << x << ", " << radius;
      EXPECT_LE(point.x + radius + 2 * limited, rightmost + 0.5f) << x << ", " << radius;
      own_spills += point.x - radius - 3 * point.disparity < leftmost - 0.5f ? 1 : 0;
    }
  }
  EXPECT_GT(own_spills, 5) << "points with their own disparity spill";
}

TEST(DisparityWithinOutline, IsThePointsOwnElsewhere) {
  const Image<float> disparity = pillar();
  const ControlPoint middle{60.5f, 20.5f, disparity(60, 20)}, on_wall{15.5f, 20.5f, wall};
  EXPECT_EQ(disparity_within_outline({disparity, threshold_px, {2, 3}}, middle, 4), middle.disparity);
  // Beside something nearer, which hides it.
  EXPECT_EQ(disparity_within_outline({disparity, threshold_px, {2, 3}}, on_wall, 12), wall);
  const ControlPoint at_end{34.5f, 20.5f, disparity(34, 20)};
  EXPECT_EQ(disparity_within_outline({disparity, threshold_px, {}}, at_end, 4), at_end.disparity);
  EXPECT_EQ(disparity_within_outline({disparity, threshold_px, {2, 0}}, at_end, 4), at_end.disparity);
  EXPECT_LT(disparity_within_outline({disparity, threshold_px, {0, 3}}, at_end, 4), at_end.disparity);
}

}  // namespace wheatstone::outline_disparity_test
