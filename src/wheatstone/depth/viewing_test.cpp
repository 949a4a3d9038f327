// Eyes before a screen, depth mapping, cameras and rigs.

#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/depth_mapping.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {
namespace {

/// Where the lines from the two eyes through their pixels meet, by plain geometry.
double crossing_behind(double separation, double distance, double parallax) {
  // The left eye at −E/2 looks through −p/2 at the screen, the right one through p/2: x = 0 at Z·E/(E − p).
  return distance * separation / (separation - parallax) - distance;
}

TEST(ViewingGeometry, PerceivesPointsWhereTheLinesOfSightMeet) {
  const ViewingGeometry viewing{.eye_separation_mm = 65, .viewing_distance_mm = 700};
  for (const float parallax : {-30.f, -1.f, 0.f, 1.f, 20.f, 60.f})
    EXPECT_NEAR(perceived_depth_mm(viewing, parallax), crossing_behind(65, 700, parallax), 1e-3 * 700);
  EXPECT_TRUE(std::isinf(perceived_depth_mm(viewing, 65)));
  EXPECT_TRUE(std::isinf(perceived_depth_mm(viewing, 80)));
}

TEST(ViewingGeometry, ParallaxAndPerceivedDepthAreInverse) {
  const ViewingGeometry viewing{.eye_separation_mm = 60, .viewing_distance_mm = 900};
  for (const float behind : {-500.f, -100.f, 0.f, 50.f, 3000.f})
    EXPECT_NEAR(perceived_depth_mm(viewing, screen_parallax_mm(viewing, behind)), behind,
                1e-2 + 1e-4 * std::abs(behind));
}

TEST(ViewingGeometry, ResolutionIsTheThesiss) {
  EXPECT_NEAR(stereoscopic_resolution({65, 750, 376, 1280}, 100, 100), 60, 0.5);
  EXPECT_NEAR(stereoscopic_resolution({65, 630, 376, 640}, 100, 100), 36, 0.5);
}

TEST(Comfort, WarnsOfMoreThanADeskOrADegree) {
  const ViewingGeometry desk{.viewing_distance_mm = 700};
  EXPECT_TRUE(discomforts(desk, 100, 100).empty());
  EXPECT_FALSE(discomforts(desk, 101, 100).empty());
  const ViewingGeometry cinema{.viewing_distance_mm = 10000, .screen_width_mm = 8000};
  EXPECT_TRUE(discomforts(cinema, 1000, 3000).empty());
  EXPECT_FALSE(discomforts(cinema, 8000, 3000).empty());
  EXPECT_FALSE(discomforts({.eye_separation_mm = 90, .viewing_distance_mm = 2000}, 0, 1e6f).empty());
}

TEST(Comfort, AngularDisparityIsTheDifferenceOfVergences) {
  const ViewingGeometry viewing{.eye_separation_mm = 65, .viewing_distance_mm = 700};
  const double degrees = (2 * std::atan(32.5 / 600) - 2 * std::atan(32.5 / 700)) * 180 / M_PI;
  EXPECT_NEAR(angular_disparity_deg(viewing, -100), degrees, 1e-4);
  EXPECT_LT(angular_disparity_deg(viewing, 100), 0);
}

TEST(DepthMapping, SingleRegionIsWhatParallelCamerasSee) {
  // Cameras of separation A and focal length f, converged at 4: p = A·f·(1/4 − 1/z).
  const auto camera = [](float z) { return 120 * (0.25f - 1 / z); };
  const DepthMapping mapping{{{2, camera(2)}, {10, camera(10)}}};
  for (const float z : {2.f, 3.f, 4.f, 5.f, 9.f, 10.f}) EXPECT_NEAR(parallax_px(mapping, z), camera(z), 1e-4);
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

TEST(Rig, ViewsAreEvenlySpacedAroundTheCentre) {
  EXPECT_EQ(evenly_spaced(4, 3, 5, 2).positions, (std::vector<float>{-1, -0.5f, 0, 0.5f, 1}));
  EXPECT_EQ(evenly_spaced(4, 3, 1).positions, (std::vector<float>{0}));
  EXPECT_EQ(evenly_spaced(4, 3, 2).positions, (std::vector<float>{-0.5f, 0.5f}));
}

TEST(Camera, SeesAllOfTheSphereAndNotMuchElse) {
  const Camera camera = camera_around({1, 2, 3}, 5, 640, 360, {.azimuth_deg = 70, .elevation_deg = -30});
  const auto dot = [](const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  EXPECT_NEAR(dot(camera.right, camera.down), 0, 1e-6);
  EXPECT_NEAR(dot(camera.right, camera.forward), 0, 1e-6);
  EXPECT_NEAR(dot(camera.down, camera.forward), 0, 1e-6);
  float highest = 360;
  for (int i = 0; i < 1000; ++i) {
    const float a = 0.1f * static_cast<float>(i);
    const float b = 1.7f * static_cast<float>(i);
    const std::array<float, 3> at{1 + 5 * std::cos(a) * std::cos(b) - camera.position[0],
                                  2 + 5 * std::cos(a) * std::sin(b) - camera.position[1],
                                  3 + 5 * std::sin(a) - camera.position[2]};
    const float depth = dot(at, camera.forward);
    const float y = camera.centre_y_px + camera.focal_px * dot(at, camera.down) / depth;
    EXPECT_GT(depth, 0);
    EXPECT_GT(y, -0.5f);
    highest = std::min(highest, y);
  }
  EXPECT_LT(highest, 10);
}

}  // namespace
}  // namespace wheatstone
