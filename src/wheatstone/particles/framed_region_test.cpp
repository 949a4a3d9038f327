#include "wheatstone/particles/framed_region.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wheatstone/particles/cloud_statistics.h"
#include "wheatstone/random.h"

namespace wheatstone::framed_region_test {

using testing::ElementsAre;

Cloud cube(std::size_t count) {
  Cloud cloud;
  for (std::uint64_t i = 0; i < count; ++i) {
    cloud.x.push_back(unit_float(hash_keys({i, 1})));
    cloud.y.push_back(unit_float(hash_keys({i, 2})));
    cloud.z.push_back(unit_float(hash_keys({i, 3})));
  }
  return cloud;
}

CloudStatistics statistics_of(const Cloud& cloud) {
  CloudStatistics statistics;
  statistics.add(cloud);
  return statistics;
}

TEST(FramedRegion, LeavesOutOneFarOutlierAndNothingElse) {
  Cloud cloud = cube(200);
  const CloudStatistics without = statistics_of(cloud);
  EXPECT_EQ(framed_region(without, {}).lower, without.lower);
  EXPECT_EQ(framed_region(without, {}).upper, without.upper);
  cloud.x.push_back(1000);
  cloud.y.push_back(-1000);
  cloud.z.push_back(0.5f);
  const FramedRegion region = framed_region(statistics_of(cloud), {});
  EXPECT_EQ(region.lower, without.lower);
  EXPECT_EQ(region.upper, without.upper);
  EXPECT_EQ(count_outside(cloud, region), 1u);
  const FramedRegion all = framed_region(statistics_of(cloud), FitAll{});
  EXPECT_EQ(all.upper[0], 1000);
  EXPECT_EQ(count_outside(cloud, all), 0u);
}

TEST(FramedRegion, OfAFewParticlesHasThemAll) {
  Cloud cloud = cube(8);
  cloud.x[3] = 1e6f;
  EXPECT_EQ(framed_region(statistics_of(cloud), {}).upper[0], 1e6f);
}

TEST(FramedRegion, OfAShareIsTheMiddleShareOfEachAxis) {
  const Cloud cloud = cube(100'000);
  const FramedRegion region = framed_region(statistics_of(cloud), FitShare{0.9});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(region.lower[axis], 0.05, 0.005);
    EXPECT_NEAR(region.upper[axis], 0.95, 0.005);
  }
  EXPECT_NEAR(static_cast<double>(count_outside(cloud, region)) / 100'000, 1 - 0.9 * 0.9 * 0.9, 0.005);
  EXPECT_EQ(framed_region(statistics_of(cloud), FitShare{1}).lower, statistics_of(cloud).lower);
}

TEST(FramedRegion, IsTheSameInChunksOfALargeCloud) {
  const Cloud cloud = cube(300'000);
  CloudStatistics in_chunks;
  for (std::size_t first = 0; first < cloud.size(); first += 70'001) {
    const std::size_t end = std::min(first + 70'001, cloud.size());
    const auto part = [&](const std::vector<float>& axis) {
      return std::vector<float>(axis.begin() + static_cast<std::ptrdiff_t>(first),
                                axis.begin() + static_cast<std::ptrdiff_t>(end));
    };
    in_chunks.add({.x = part(cloud.x), .y = part(cloud.y), .z = part(cloud.z)});
  }
  const FramedRegion region = framed_region(statistics_of(cloud), FitShare{0.99});
  EXPECT_EQ(framed_region(in_chunks, FitShare{0.99}).lower, region.lower);
  EXPECT_NEAR(region.lower[0], 0.005, 0.002);
}

TEST(FramedRegion, OfABoxOrSphereIsRelativeToTheOrigin) {
  Cloud cloud = cube(1000);
  cloud.origin = {1e8, 0, 0};
  const CloudStatistics statistics = statistics_of(cloud);
  const FramedRegion box = framed_region(statistics, Box{{1e8, 0, 0}, {1e8 + 0.5, 1, 1}});
  EXPECT_THAT(box.upper, ElementsAre(0.5f, 1, 1));
  EXPECT_NEAR(static_cast<double>(count_outside(cloud, box)), 500, 60);
  const FramedRegion sphere = framed_region(statistics, Sphere{{1e8 + 0.5, 0.5, 0.5}, 0.5});
  EXPECT_THAT(sphere.centre(), ElementsAre(0.5f, 0.5f, 0.5f));
  EXPECT_EQ(sphere.radius(), 0.5f);
  EXPECT_NEAR(static_cast<double>(count_outside(cloud, sphere)), 1000 * (1 - 0.5236), 60);
}

}  // namespace wheatstone::framed_region_test
