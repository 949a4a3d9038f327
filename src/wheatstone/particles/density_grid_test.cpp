#include "wheatstone/particles/density_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/particles/sph_density.h"
#include "wheatstone/random.h"

namespace wheatstone::density_grid_test {

float random(std::uint64_t i, std::uint64_t which) { return unit_float(hash_keys({i, which})); }

/// A knot around (3, −2, 1) in a thin gas, whose density falls with the cube of the distance.
Cloud knot(std::uint64_t count) {
  Cloud cloud;
  for (std::uint64_t i = 0; i < count; ++i) {
    const float away = i % 4 == 0 ? 10 * std::cbrt(random(i, 0)) : 0.03f * std::pow(300.f, random(i, 0));
    const float azimuth = 6.2831853f * random(i, 1);
    const float height = 2 * random(i, 2) - 1;
    const float around = std::sqrt(1 - height * height);
    cloud.x.push_back(3 + away * around * std::cos(azimuth));
    cloud.y.push_back(-2 + away * around * std::sin(azimuth));
    cloud.z.push_back(1 + away * height);
  }
  return cloud;
}

std::vector<Cloud> chunks_of(const Cloud& cloud, std::size_t most) {
  std::vector<Cloud> chunks;
  for (std::size_t first = 0; first < cloud.size(); first += most) {
    Cloud& chunk = chunks.emplace_back();
    for (std::size_t i = first; i < std::min(first + most, cloud.size()); ++i) {
      chunk.x.push_back(cloud.x[i]);
      chunk.y.push_back(cloud.y[i]);
      chunk.z.push_back(cloud.z[i]);
    }
  }
  return chunks;
}

DensityGrid grid_of(const std::vector<Cloud>& chunks) {
  DensityGrid grid;
  for (const Cloud& chunk : chunks) grid.add(chunk);
  grid.finish();
  return grid;
}

TEST(DensityGrid, AgreesWithTheNeighboursToWithinAFactorOfTwoForMost) {
  const Cloud cloud = knot(10000);
  Cloud counted = cloud;
  grid_of({cloud}).put_densities(counted);
  Cloud estimated = cloud;
  estimate_density(estimated, 32, {});
  std::size_t near = 0;
  std::size_t as_far = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    near += std::abs(std::log2(counted.smoothing_length[i] / estimated.smoothing_length[i])) < 1;
    // All alike would be told apart.
    as_far += std::abs(std::log2(estimated.smoothing_length[0] / estimated.smoothing_length[i])) < 1;
  }
  EXPECT_GT(near, cloud.size() * 17 / 20);
  EXPECT_LT(as_far, cloud.size() / 2);
}

TEST(DensityGrid, IsTheSameInChunksOfAnySizeAndOrderOfPlaces) {
  Cloud cloud = knot(5000);
  // The first chunk lies in one corner, so that the grid must grow.
  std::ranges::sort(cloud.x);
  Cloud whole = cloud;
  Cloud in_chunks = cloud;
  grid_of({cloud}).put_densities(whole);
  grid_of(chunks_of(cloud, 77)).put_densities(in_chunks);
  EXPECT_EQ(whole.density, in_chunks.density);
}

TEST(DensityGrid, IsNotCoarserForOneThatLiesFarOut) {
  const Cloud cloud = knot(3000);
  Cloud alone = cloud;
  grid_of({cloud}).put_densities(alone);
  Cloud far;
  far.x = far.y = far.z = {1e6f};
  for (const bool in_the_same_chunk : {false, true}) {
    Cloud beside = cloud;
    if (in_the_same_chunk)
      for (std::vector<float>* axis : {&beside.x, &beside.y, &beside.z}) axis->push_back(1e6f);
    grid_of(in_the_same_chunk ? std::vector{beside} : std::vector{beside, far}).put_densities(beside);
    std::size_t near = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      near += std::abs(std::log2(beside.smoothing_length[i] / alone.smoothing_length[i])) < 0.5f;
    EXPECT_GT(near, cloud.size() * 19 / 20);
  }
}

TEST(DensityGrid, IsSteepestTowardsTheKnot) {
  const DensityGrid grid = grid_of({knot(60000)});
  for (const std::array<float, 3> away : {std::array{1.f, 0.f, 0.f}, {0.f, -1.f, 0.f}, {0.f, 0.6f, 0.8f}}) {
    const std::array<float, 3> slope = grid.slope(3 + 2 * away[0], -2 + 2 * away[1], 1 + 2 * away[2]);
    const float length = std::hypot(slope[0], slope[1], slope[2]);
    EXPECT_GT(length, 0.02f);
    EXPECT_LT((slope[0] * away[0] + slope[1] * away[1] + slope[2] * away[2]) / length, -0.9f);
  }
}

TEST(DensityGrid, IsFiniteOfOneParticleAndOfManyInOnePlace) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{100}}) {
    Cloud cloud;
    cloud.x = cloud.y = cloud.z = std::vector<float>(count, 5.f);
    grid_of({cloud}).put_densities(cloud);
    for (const float density : cloud.density) EXPECT_TRUE(std::isfinite(density) && density > 0);
    for (const float length : cloud.smoothing_length) EXPECT_TRUE(std::isfinite(length) && length > 0);
  }
}

}  // namespace wheatstone::density_grid_test
