// What is done to clouds: selecting, estimating density, making a universe and writing it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/particles/cosmology.h"
#include "wheatstone/particles/select.h"
#include "wheatstone/particles/sph_density.h"
#include "wheatstone/particles/write_gadget.h"
#include "wheatstone/random.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::cloud_test {

using testing::ElementsAre;

Cloud points(std::vector<float> x) {
  Cloud cloud;
  cloud.y = cloud.z = std::vector<float>(x.size(), 0.f);
  cloud.x = std::move(x);
  return cloud;
}

TEST(Select, DropsAndCountsWhatHasNoPlace) {
  Cloud cloud = points({1, NAN, 3, INFINITY, 5});
  cloud.density = {1, 2, 3, 4, 5};
  const SelectionCounts counts = select_particles(cloud, {});
  EXPECT_EQ(counts.dropped, 2u);
  EXPECT_THAT(cloud.x, ElementsAre(1, 3, 5));
  EXPECT_THAT(cloud.density, ElementsAre(1, 3, 5));
}

TEST(Select, MendsAndCountsDensitiesNotAboveZero) {
  Cloud cloud = points({1, 2, 3, 4});
  cloud.density = {-1, 0, NAN, 4};
  EXPECT_EQ(select_particles(cloud, {}).mended, 3u);
  EXPECT_GT(std::ranges::min(cloud.density), 0);
  EXPECT_EQ(cloud.density[3], 4);
}

TEST(Select, CutsSpheresAndBoxes) {
  Cloud cloud = points({1, 2, 3, 4, 5});
  select_particles(cloud, {.cut = Sphere{{3, 0, 0}, 1}});
  EXPECT_THAT(cloud.x, ElementsAre(2, 3, 4));
  select_particles(cloud, {.cut = Box{{2.5, -1, -1}, {9, 1, 1}}});
  EXPECT_THAT(cloud.x, ElementsAre(3, 4));
}

TEST(Select, EveryNthIsTheSameInChunks) {
  std::vector<float> x(100);
  std::iota(x.begin(), x.end(), 0.f);
  Cloud whole = points(x);
  select_particles(whole, {.every = 7});
  std::vector<float> joined;
  for (std::size_t first = 0; first < 100; first += 33) {
    Cloud chunk = points({x.begin() + static_cast<std::ptrdiff_t>(first),
                          x.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(first + 33, 100))});
    select_particles(chunk, {.every = 7}, first);
    joined.insert(joined.end(), chunk.x.begin(), chunk.x.end());
  }
  EXPECT_EQ(joined, whole.x);
}

TEST(Select, EveryNthHasTheMassOfAll) {
  Cloud heavy = points({0, 1, 2, 3, 4, 5, 6, 7});
  heavy.mass = std::vector<float>(8, 2.f);
  heavy.smoothing_length = std::vector<float>(8, 0.5f);
  select_particles(heavy, {.every = 8});
  EXPECT_THAT(heavy.mass, ElementsAre(16));
  EXPECT_THAT(heavy.smoothing_length, ElementsAre(1));
  Cloud bright = points({0, 1, 2, 3});
  bright.presence = {5, 5, 5, 5};
  select_particles(bright, {.every = 2});
  EXPECT_THAT(bright.presence, ElementsAre(10, 10));
  Cloud without_mass = points({0, 1, 2, 3, 4, 5});
  select_particles(without_mass, {.every = 3});
  EXPECT_THAT(without_mass.presence, ElementsAre(3, 3));
}

TEST(Select, MovesAPointToTheMiddleOfAPeriodicBox) {
  Cloud cloud = points({9, 1, 5});
  cloud.box_size = 10;
  select_particles(cloud, {.centre = {{0, 0, 0}}});
  EXPECT_THAT(cloud.origin, ElementsAre(5, 5, 5));
  EXPECT_THAT(cloud.x, ElementsAre(-1, 1, -5));
  EXPECT_THAT(cloud.y, ElementsAre(0, 0, 0));
}

TEST(SphDensity, OfALatticeIsOne) {
  Cloud cloud;
  cloud.box_size = 10;
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 10; ++x) {
        cloud.x.push_back(static_cast<float>(x) + 0.5f);
        cloud.y.push_back(static_cast<float>(y) + 0.5f);
        cloud.z.push_back(static_cast<float>(z) + 0.5f);
      }
  estimate_density(cloud, 33);
  const auto [least, most] = std::ranges::minmax(cloud.density);
  EXPECT_NEAR(least, 1, 0.12);  // its sides are like its middle: the box is periodic
  EXPECT_NEAR(most, least, 1e-3);
  cloud.box_size = 0;
  estimate_density(cloud, 33);
  EXPECT_LT(std::ranges::min(cloud.density), 0.6);
}

TEST(SphDensity, EqualsTheSumOverAllParticles) {
  Cloud cloud;
  for (std::uint64_t i = 0; i < 300; ++i) {
    cloud.x.push_back(unit_float(hash_keys({i, 1})));
    cloud.y.push_back(unit_float(hash_keys({i, 2})));
    cloud.z.push_back(unit_float(hash_keys({i, 3})));
  }
  estimate_density(cloud, 20);
  for (std::size_t i = 0; i < 300; i += 37) {
    std::vector<double> distances;
    for (std::size_t k = 0; k < 300; ++k)
      distances.push_back(std::hypot(cloud.x[i] - cloud.x[k], cloud.y[i] - cloud.y[k], cloud.z[i] - cloud.z[k]));
    std::ranges::sort(distances);
    const double h = distances[19] / 2;
    double sum = 0;
    for (const double r : distances) {
      const double q = r / h;
      const double w = q < 1 ? 1 - 1.5 * q * q + 0.75 * q * q * q : q < 2 ? 0.25 * std::pow(2 - q, 3) : 0;
      sum += w / (M_PI * h * h * h);
    }
    EXPECT_NEAR(cloud.density[i], sum, 1e-3 * sum);
  }
}

TEST(SphDensity, IsFiniteWhereAllIsInOnePlace) {
  for (const std::size_t count : {1, 2, 100}) {
    Cloud cloud = points(std::vector<float>(count, 5.f));
    estimate_density(cloud);
    for (const float density : cloud.density) EXPECT_TRUE(std::isfinite(density) && density > 0);
  }
}

TEST(Cosmology, SpectrumMakesSigma8AndGrowthIsOneToday) {
  double variance = 0;
  for (double k = 1e-4; k < 100; k *= 1.01) {
    const double x = 8 * k;
    const double ball = 3 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
    variance += k * k * k * cdm_power(k) * ball * ball * std::log(1.01) / (2 * M_PI * M_PI);
  }
  EXPECT_NEAR(std::sqrt(variance), sigma_8, 0.01);
  EXPECT_DOUBLE_EQ(growth(0), 1);
  EXPECT_NEAR(growth(9) * 10, 1.28, 0.05);  // as if matter were all, but for the last few billion years
  EXPECT_GT(cdm_power(0.02), cdm_power(0.0005));
  EXPECT_GT(cdm_power(0.02), cdm_power(1));
}

/// Variance over mean of the numbers of particles in 8³ cells: 1 where they are strewn at random.
double clumpiness(const Cloud& cloud) {
  std::vector<double> counts(512, 0);
  const double cell = cloud.box_size / 8;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto index = [&](float at) { return std::min(static_cast<std::size_t>(at / cell), std::size_t{7}); };
    ++counts[(index(cloud.x[i]) * 8 + index(cloud.y[i])) * 8 + index(cloud.z[i])];
  }
  const double mean = static_cast<double>(cloud.size()) / 512;
  double sum = 0;
  for (const double count : counts) sum += (count - mean) * (count - mean);
  return sum / 512 / mean;
}

TEST(SyntheticUniverse, HasKnotsAndVoidsThatGrowWithTime) {
  const Cloud today = make_synthetic_universe({.particles = 50000});
  const Cloud early = make_synthetic_universe({.particles = 50000, .redshift = 10});
  EXPECT_GT(clumpiness(today), 20);
  EXPECT_LT(clumpiness(early), clumpiness(today) / 5);
  std::vector<float> density = today.density;
  std::ranges::sort(density);
  EXPECT_GT(density[49000] / density[25000], 5);
  EXPECT_GT(density[25000] / density[2000], 2);
}

TEST(SyntheticUniverse, GivesExactlyAsManyAsAskedForInsideItsBox) {
  for (const std::uint64_t count : {1, 2, 1000, 12345}) {
    const Cloud cloud = make_synthetic_universe({.particles = count});
    EXPECT_EQ(cloud.size(), count);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_GE(std::min({cloud.x[i], cloud.y[i], cloud.z[i]}), 0);
      ASSERT_LT(std::max({cloud.x[i], cloud.y[i], cloud.z[i]}), cloud.box_size);
      ASSERT_TRUE(cloud.density[i] > 0 && cloud.temperature[i] > 0 && cloud.smoothing_length[i] > 0);
    }
  }
  expect_error(ErrorKind::wrong_usage, "particles is 0", [] { make_synthetic_universe({.particles = 0}); });
  expect_error(ErrorKind::wrong_usage, "redshift is -1", [] { make_synthetic_universe({.redshift = -1}); });
}

TEST(SyntheticUniverse, SameSeedSameBytesOnAnyNumberOfThreadsAndInChunks) {
  const Cloud cloud = make_synthetic_universe({.particles = 20000, .seed = 3});
  EXPECT_NE(make_synthetic_universe({.particles = 20000, .seed = 4}).x, cloud.x);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  SyntheticUniverse universe({.particles = 20000, .seed = 3});
  std::vector<float> x;
  std::vector<float> temperature;
  for (Cloud chunk = universe.next(777); chunk.size() > 0; chunk = universe.next(777)) {
    x.insert(x.end(), chunk.x.begin(), chunk.x.end());
    temperature.insert(temperature.end(), chunk.temperature.begin(), chunk.temperature.end());
  }
  EXPECT_EQ(x, cloud.x);
  EXPECT_EQ(temperature, cloud.temperature);
}

TEST(GadgetWriter, WritesWhatTheReaderReads) {
  const TemporaryFolder folder;
  const Cloud cloud = make_synthetic_universe({.particles = 5000});
  {
    GadgetWriter writer(folder / "u.hdf5",
                        {.particles = 5000, .box_size = cloud.box_size, .redshift = 0.5, .mass_of_a_particle = 2});
    writer.add(cloud);
    EXPECT_FALSE(std::filesystem::exists(folder / "u.hdf5"));
    writer.commit();
  }
  const Cloud again = read_cloud(folder / "u.hdf5");
  EXPECT_EQ(again.x, cloud.x);
  EXPECT_EQ(again.density, cloud.density);
  EXPECT_EQ(again.box_size, cloud.box_size);
  for (std::size_t i = 0; i < 5000; i += 100)
    EXPECT_NEAR(again.temperature[i], cloud.temperature[i], 1e-5 * cloud.temperature[i]);
  EXPECT_EQ(open_cloud(folder / "u.hdf5").redshift, 0.5);
}

TEST(GadgetWriter, LeavesNothingUnlessCommitted) {
  const TemporaryFolder folder;
  { const GadgetWriter writer(folder / "u.hdf5", {.particles = 5, .box_size = 1}); }
  EXPECT_TRUE(folder.is_empty());
  expect_error(ErrorKind::cannot_read_write, "cannot write",
               [&] { GadgetWriter("/dev/null/u.hdf5", {.particles = 5}); });
}

}  // namespace wheatstone::cloud_test
