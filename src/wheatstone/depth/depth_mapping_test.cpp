// From scene depth to parallax: regions, curves, tables, text.

#include "wheatstone/depth/depth_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "throws_error.h"

namespace wheatstone {
namespace {

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

TEST(DepthMapping, RegionsGetTheirSharesOfThePlanes) {
  const std::vector<DepthRegion> regions{{20, 1}, {25, 4}, {60, 1}};
  const DepthMapping mapping = regions_by_share(10, regions, -12, 18);
  EXPECT_EQ(mapping.points, (std::vector<DepthMapping::Point>{{10, -12}, {20, -7}, {25, 13}, {60, 18}}));
  expect_error(ErrorKind::wrong_usage, "share of -1", [] {
    regions_by_share(1, std::vector<DepthRegion>{{2, -1}}, 0, 1);
  });
  expect_error(ErrorKind::wrong_usage, "no shares", [] { regions_by_share(1, {}, 0, 1); });
  expect_error(ErrorKind::wrong_usage, "ascending", [] {
    regions_by_share(5, std::vector<DepthRegion>{{2, 1}}, 0, 1);
  });
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

TEST(DepthMapping, TableOfOneRegionIsExactBetweenItsEntries) {
  const DepthMapping region = single_region(2, 50, desk, 100, 100);
  const std::vector<float> table = tabulate(region, 0.5f, 0.02f, 9);
  ASSERT_EQ(table.size(), 9u);
  EXPECT_FLOAT_EQ(table.front(), region.points[0].parallax_px);
  EXPECT_FLOAT_EQ(table.back(), region.points[1].parallax_px);
  const auto looked_up = [&](float depth) {
    const float at = (0.5f - 1 / depth) / 0.48f * 8;
    const auto entry = static_cast<std::size_t>(at);
    const float share = at - static_cast<float>(entry);
    return table[entry] * (1 - share) + table[entry + 1] * share;
  };
  for (const float depth : {2.1f, 3.3f, 7.7f, 20.f, 49.f})
    EXPECT_NEAR(looked_up(depth), parallax_px(region, depth), 2e-4) << depth;
  EXPECT_EQ(tabulate(region, 0.5f, 0.02f, 1), std::vector<float>{table.front()});
}

TEST(DepthMapping, IsReadFromText) {
  EXPECT_EQ(parse_depth_mapping("10:-8,20:0,60:8").points,
            (std::vector<DepthMapping::Point>{{10, -8}, {20, 0}, {60, 8}}));
  EXPECT_EQ(parse_depth_mapping("1.5:-2.25").points, (std::vector<DepthMapping::Point>{{1.5f, -2.25f}}));
  for (const std::string text : {"", "10", "10:", "10:-8,", "10:-8,20", ",10:1", "10:-8;20:1", "10:a", "10:-8,20:0x"})
    expect_error(ErrorKind::wrong_usage, "--depth-map: is '" + text + "'",
                 [&] { parse_depth_mapping(text, "--depth-map"); });
}

TEST(DepthMapping, RefusesWhatDescendsOrIsNoDepth) {
  for (const std::string text :
       {"20:0,10:5", "10:0,10:5", "10:5,20:4", "0:1,2:3", "-1:1,2:3", "1:nan", "1:inf", "nan:1,2:3"})
    expect_error(ErrorKind::wrong_usage, "expected", [&] { parse_depth_mapping(text); });
  expect_error(ErrorKind::wrong_usage, "no points", [] { check_depth_mapping({}); });
  expect_error(ErrorKind::wrong_usage, "behind the viewer", [] { single_region(1, 2, desk, 700, 10); });
  expect_error(ErrorKind::wrong_usage, "ascending", [] { single_region(2, 2, desk, 10, 10); });
  EXPECT_NO_THROW(single_region(1, 2, desk, 699, 10));
}

}  // namespace
}  // namespace wheatstone
