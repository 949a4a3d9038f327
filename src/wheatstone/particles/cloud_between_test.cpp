// Particles between two snapshots.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/particles/cloud_between.h"
#include "wheatstone/particles/write_gadget.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::cloud_between_test {

using testing::ElementsAre;
using testing::FloatNear;

constexpr double box = 1000;

/// Particles on a line through a periodic box, in the order of their IDs.
TimedCloud on_a_line(double time, std::vector<std::uint64_t> ids, std::vector<float> x, std::vector<float> rates) {
  TimedCloud timed;
  timed.time = time;
  timed.cloud.box_size = box;
  timed.cloud.y = timed.cloud.z = std::vector<float>(x.size(), 500.f);
  timed.cloud.rate_y = timed.cloud.rate_z = std::vector<float>(x.size(), 0.f);
  timed.cloud.x = std::move(x);
  timed.cloud.rate_x = std::move(rates);
  timed.cloud.id = std::move(ids);
  return timed;
}

Cloud between(const TimedCloud& earlier, const TimedCloud& later, double time) {
  return cloud_between(earlier, later, match_particles(earlier.cloud, later.cloud), time);
}

TEST(CloudBetween, FollowsPositionsAndVelocitiesAtBothEnds) {
  // x = 100 + 10 t + 3 t² + 2 t³
  const TimedCloud earlier = on_a_line(0, {7}, {100}, {10}), later = on_a_line(2, {7}, {148}, {46});
  for (const double t : {0., 0.5, 1.3, 2.}) {
    const auto expected = static_cast<float>(100 + 10 * t + 3 * t * t + 2 * t * t * t);
    EXPECT_THAT(between(earlier, later, t).x, ElementsAre(FloatNear(expected, 1e-4f)));
  }
}

TEST(CloudBetween, TakesTheShorterWayThroughThePeriodicBox) {
  const TimedCloud earlier = on_a_line(1, {1, 2}, {990, 20}, {20, -40}),
                   later = on_a_line(2, {1, 2}, {10, 980}, {20, -40});
  EXPECT_THAT(between(earlier, later, 1.25).x, ElementsAre(FloatNear(995, 1e-3f), FloatNear(10, 1e-3f)));
  EXPECT_THAT(between(earlier, later, 1.75).x, ElementsAre(FloatNear(5, 1e-3f), FloatNear(990, 1e-3f)));
}

TEST(CloudBetween, FadesParticlesThatOneSnapshotLacks) {
  const TimedCloud earlier = on_a_line(0, {1, 2}, {100, 200}, {0, 8}), later = on_a_line(4, {1, 3}, {100, 300}, {0, 8});
  const Cloud cloud = between(earlier, later, 1);
  EXPECT_THAT(cloud.x, ElementsAre(100, 208, 276));
  EXPECT_THAT(cloud.presence, ElementsAre(1, FloatNear(0.84375f, 1e-6f), FloatNear(0.15625f, 1e-6f)));
  EXPECT_TRUE(between(earlier, earlier, 0).presence.empty());
  // Particles that give more light fade from it.
  TimedCloud bright = earlier, later_too = later;
  bright.cloud.presence = later_too.cloud.presence = {3, 2};
  EXPECT_THAT(between(bright, later_too, 1).presence,
              ElementsAre(3, FloatNear(2 * 0.84375f, 1e-6f), FloatNear(2 * 0.15625f, 1e-6f)));
  // Of a snapshot of which no particle was chosen, the other's keep what they have.
  TimedCloud full = later;
  full.cloud.density = {5, 6};
  const TimedCloud none = on_a_line(0, {}, {}, {});
  EXPECT_THAT(between(none, full, 1).density, ElementsAre(5, 6));
  EXPECT_EQ(between(none, full, 1).presence.size(), 2u);
}

TEST(CloudBetween, ChangesDensityByEqualFactorsInEqualTimes) {
  TimedCloud earlier = on_a_line(0, {1}, {100}, {0}), later = on_a_line(2, {1}, {100}, {0});
  earlier.cloud.density = {1};
  later.cloud.density = {100};
  EXPECT_THAT(between(earlier, later, 1).density, ElementsAre(FloatNear(10, 1e-4f)));
  earlier.cloud.mass = {3};
  later.cloud.mass = {3};
  earlier.cloud.quantity = {-1};
  later.cloud.quantity = {2};
  EXPECT_THAT(between(earlier, later, 1).mass, ElementsAre(3));
  EXPECT_THAT(between(earlier, later, 1).quantity, ElementsAre(0.5f));
}

TEST(CloudBetween, IsTenTimesNearerToTheTruthThanStraightLines) {
  const TemporaryFolder folder;
  const auto snapshot = [&](double scale) {
    const std::filesystem::path path = folder / "snap.hdf5";
    write_synthetic_universe(path, {.particles = 8000, .redshift = 1 / scale - 1, .motion = true});
    return read_timed_cloud(path, {});
  };
  TimedCloud earlier = snapshot(0.5), later = snapshot(0.6);
  const TimedCloud truth = snapshot(0.55);
  const auto median_error = [&] {
    const Cloud cloud = between(earlier, later, truth.time);
    std::vector<double> errors;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      errors.push_back(std::hypot(std::remainder(cloud.x[i] - truth.cloud.x[i], cloud.box_size),
                                  std::remainder(cloud.y[i] - truth.cloud.y[i], cloud.box_size),
                                  std::remainder(cloud.z[i] - truth.cloud.z[i], cloud.box_size)));
    std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
    return errors[errors.size() / 2];
  };
  const double curved = median_error();
  for (TimedCloud* timed : {&earlier, &later})
    for (auto rate : {&Cloud::rate_x, &Cloud::rate_y, &Cloud::rate_z}) (timed->cloud.*rate).clear();
  const double straight = median_error();
  RecordProperty("curved_kpc", std::to_string(curved));
  RecordProperty("straight_kpc", std::to_string(straight));
  EXPECT_LE(curved, straight / 10);
}

TEST(ReadTimedCloud, KeepsWhatIsChosenInEachSnapshot) {
  const TemporaryFolder folder;
  Cloud cloud = on_a_line(0, {5, 3, 4}, {1, 2, 3}, {0, 0, 0}).cloud;
  cloud.density = cloud.temperature = cloud.smoothing_length = {1, 2, 3};
  GadgetWriter writer(folder / "snap.hdf5", {.particles = 3, .box_size = box, .motion = true});
  writer.add(cloud);
  writer.commit();
  const auto chosen = [&](const char* where) {
    return read_timed_cloud(folder / "snap.hdf5", {.where = parse_condition(where)}).cloud;
  };
  EXPECT_THAT(chosen("Density >= 2").id, ElementsAre(3, 4));
  EXPECT_THAT(chosen("Density >= 2").density, ElementsAre(2, 3));
  EXPECT_EQ(chosen("Density > 9").size(), 0u);
}

TEST(ReadTimedCloud, RefusesWhatCannotBeFollowed) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "snap.hdf5";
  const auto write = [&](bool motion, std::vector<std::uint64_t> ids) {
    Cloud cloud = on_a_line(0, std::move(ids), {1, 2}, {0, 0}).cloud;
    cloud.density = cloud.temperature = cloud.smoothing_length = {1, 1};
    GadgetWriter writer(path, {.particles = 2, .box_size = box, .motion = motion});
    writer.add(cloud);
    writer.commit();
  };
  write(true, {5, 5});
  expect_error(ErrorKind::bad_input, "several particles with the ID 5", [&] { read_timed_cloud(path, {}); });
  write(false, {1, 2});
  expect_error(ErrorKind::bad_input, "'ParticleIDs'", [&] { read_timed_cloud(path, {}); });
  put_bytes(folder / "points.txt", "1 2 3\n4 5 6\n");
  expect_error(ErrorKind::bad_input, "points.txt: has no IDs", [&] { read_timed_cloud(folder / "points.txt", {}); });
}

}  // namespace wheatstone::cloud_between_test
