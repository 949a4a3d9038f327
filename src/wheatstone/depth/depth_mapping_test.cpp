// From scene depth to parallax: regions and curves.

#include "wheatstone/depth/depth_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "throws_error.h"

namespace wheatstone::depth_mapping_test {

constexpr ViewingGeometry desk{
    .eye_separation_mm = 65, .viewing_distance_mm = 700, .screen_width_mm = 376, .width_px = 1280};
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(DepthMapping, SingleRegionIsWhatParallelCamerasSee) {
  // Cameras of separation A and focal length f, converged at 4: p = A·f·(1/4 − 1/z).
  const auto camera = [](float z) { return 120 * (0.25f - 1 / z); };
  const DepthMapping mapping{{{2, camera(2)}, {10, camera(10)}}};
  for (const float z : {2.f, 3.f, 4.f, 5.f, 9.f, 10.f}) EXPECT_NEAR(parallax_px(mapping, z), camera(z), 1e-5);
}

TEST(DepthMapping, SingleRegionPutsTheEndsWhereTheyAreToSeem) {
  const DepthMapping mapping = single_region(2, 50, desk, 100, 80);
  const float pitch = 376.f / 1280;
  EXPECT_NEAR(perceived_depth_mm(desk, parallax_px(mapping, 2) * pitch), -100, 1e-2);
  EXPECT_NEAR(perceived_depth_mm(desk, parallax_px(mapping, 50) * pitch), 80, 1e-2);
  EXPECT_FLOAT_EQ(parallax_px(mapping, 2), -65.f * 100 / 600 / pitch);
  EXPECT_FLOAT_EQ(parallax_px(mapping, 50), 65.f * 80 / 780 / pitch);
}

TEST(DepthMapping, ReachesInfinity) {
  const DepthMapping mapping = single_region(2, infinity, desk, 100, infinity);
  EXPECT_FLOAT_EQ(parallax_px(mapping, infinity), 65.f * 1280 / 376);
  const float middle = (parallax_px(mapping, 2) + parallax_px(mapping, infinity)) / 2;
  EXPECT_FLOAT_EQ(parallax_px(mapping, 4), middle);  // 1/4 is half way from 1/2 to 0
}

TEST(DepthMapping, ManyRegionsMeetAndStayFlatBeyondTheirEnds) {
  const DepthMapping mapping{{{1, -10}, {2, 0}, {3, 0}, {4, 8}}};
  EXPECT_EQ(parallax_px(mapping, 0.5f), -10);
  EXPECT_EQ(parallax_px(mapping, 1), -10);
  EXPECT_EQ(parallax_px(mapping, 2), 0);
  EXPECT_EQ(parallax_px(mapping, 2.5f), 0);
  EXPECT_EQ(parallax_px(mapping, 4), 8);
  EXPECT_EQ(parallax_px(mapping, 100), 8);
  EXPECT_LT(parallax_px(mapping, 1.5f), 0);
}

TEST(DepthMapping, CurveGoesThroughItsPointsAndNeverTurns) {
  // A step between two flats: an ordinary cubic spline swings over at both of its ends.
  const DepthMapping through{{{1, -10}, {1.5f, -10}, {2, 10}, {3, 10}, {9, 11}}};
  const DepthMapping curve = monotone_curve(through, 50);
  EXPECT_GT(curve.points.size(), 150u);
  check_depth_mapping(curve);
  for (const DepthMapping::Point& point : through.points)
    EXPECT_EQ(parallax_px(curve, point.depth), point.parallax_px) << point.depth;
  EXPECT_EQ(parallax_px(curve, 1.2f), -10);
  EXPECT_EQ(parallax_px(curve, 2.5f), 10);
}

TEST(DepthMapping, CurveIsSmoothWhereRegionsHaveCorners) {
  const DepthMapping through{{{1, -10}, {2, -4}, {4, 10}}};
  // The slope over w = 1/depth, on either side of a depth.
  const auto jump_of_slope = [](const DepthMapping& mapping, float depth) {
    const double h = 0.004;
    const double w = 1 / depth;
    const auto at = [&](double where) { return parallax_px(mapping, static_cast<float>(1 / where)); };
    return std::abs((at(w + h) - at(w)) - (at(w) - at(w - h))) / h;
  };
  EXPECT_GT(jump_of_slope(through, 2), 20);
  EXPECT_LT(jump_of_slope(monotone_curve(through, 200), 2), 4);
}

TEST(DepthMapping, CurveThroughOneRegionIsThatRegion) {
  const DepthMapping ends = single_region(3, 40, desk, 60, 90);
  DepthMapping through = ends;
  through.points = {ends.points[0], {7, parallax_px(ends, 7)}, {12, parallax_px(ends, 12)}, ends.points[1]};
  const DepthMapping curve = monotone_curve(through);
  for (float depth = 3; depth < 40; depth += 0.37f)
    EXPECT_NEAR(parallax_px(curve, depth), parallax_px(ends, depth), 1e-4);
}

TEST(DepthMapping, RefusesWhatDescendsOrIsNoDepth) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<DepthMapping> wrong{{{{20, 0}, {10, 5}}}, {{{10, 0}, {10, 5}}}, {{{10, 5}, {20, 4}}},
                                        {{{0, 1}, {2, 3}}},   {{{-1, 1}, {2, 3}}},  {{{1, nan}}},
                                        {{{1, infinity}}},    {{{nan, 1}, {2, 3}}}};
  for (const DepthMapping& mapping : wrong)
    expect_error(ErrorKind::wrong_usage, "expected", [&] { check_depth_mapping(mapping); });
  expect_error(ErrorKind::wrong_usage, "no points", [] { check_depth_mapping({}); });
  expect_error(ErrorKind::wrong_usage, "behind the viewer", [] { single_region(1, 2, desk, 700, 10); });
  expect_error(ErrorKind::wrong_usage, "ascending", [] { single_region(2, 2, desk, 10, 10); });
  EXPECT_NO_THROW(single_region(1, 2, desk, 699, 10));
}

}  // namespace wheatstone::depth_mapping_test
