// Eyes before a screen, cameras and rigs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone::viewing_test {

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

TEST(ViewingGeometry, InfinityIsAnEyeSeparationWide) {
  EXPECT_EQ(screen_parallax_mm({.eye_separation_mm = 63}, std::numeric_limits<float>::infinity()), 63);
  EXPECT_EQ(perceived_depth_mm({.eye_separation_mm = 63}, 63), std::numeric_limits<float>::infinity());
}

TEST(ViewingGeometry, DepthIsProportionalToTheViewingDistance) {
  // What the thesis calls the key property of eqs. 2.1.3 and 2.1.4.
  for (const float parallax : {-20.f, 12.f})
    EXPECT_FLOAT_EQ(perceived_depth_mm({.viewing_distance_mm = 1400}, parallax),
                    2 * perceived_depth_mm({.viewing_distance_mm = 700}, parallax));
}

TEST(ViewingGeometry, ResolutionIsTheThesiss) {
  // Hassaine 2010, sec. 5.6, for 10 cm either way: 60 planes on 2x1280x1024, 36 on nine views of 640x360. It names no
  // width or distance; these are what gives its numbers: 376 mm, a 19 inch 5:4 screen, from 750 and 630 mm.
  EXPECT_NEAR(stereoscopic_resolution({65, 750, 376, 1280}, 100, 100), 60.07, 0.01);
  EXPECT_NEAR(stereoscopic_resolution({65, 630, 376, 640}, 100, 100), 36.03, 0.01);
  // From the 700 mm that it names elsewhere (sec. 2.1.3) that screen has 64.5 and 32.3; with one distance for both
  // figures the screens would be 404 and 337 mm wide.
  EXPECT_NEAR(stereoscopic_resolution({65, 700, 376, 1280}, 100, 100), 64.54, 0.01);
  EXPECT_NEAR(stereoscopic_resolution({65, 700, 404, 1280}, 100, 100), 60, 0.1);
  EXPECT_NEAR(stereoscopic_resolution({65, 700, 337, 640}, 100, 100), 36, 0.1);
}

TEST(Rig, ViewingWindowsReplaceTheEyes) {
  // Hassaine 2010, sec. 4.3.2: with the window's width for E, parallax between neighbours is that of the window.
  const ViewingGeometry eyes{.eye_separation_mm = 65, .viewing_distance_mm = 700};
  const ViewingGeometry window{.eye_separation_mm = 26, .viewing_distance_mm = 700};
  const Rig rig = evenly_spaced(640, 360, 9, 8 * 26.f / 65);
  EXPECT_FLOAT_EQ((rig.positions[1] - rig.positions[0]) * screen_parallax_mm(eyes, 100),
                  screen_parallax_mm(window, 100));
}

TEST(Comfort, WarnsOfMoreThanADeskOrADegree) {
  const ViewingGeometry desk{.viewing_distance_mm = 700};
  EXPECT_TRUE(discomforts(desk, 100, 100).empty());
  EXPECT_FALSE(discomforts(desk, 101, 100).empty());
  EXPECT_FALSE(discomforts(desk, 100, 101).empty());
  const ViewingGeometry cinema{.viewing_distance_mm = 10000, .screen_width_mm = 8000};
  EXPECT_TRUE(discomforts(cinema, 1000, 3000).empty());
  EXPECT_FALSE(discomforts(cinema, 8000, 3000).empty());
  const auto wide =
      discomforts({.eye_separation_mm = 90, .viewing_distance_mm = 2000, .screen_width_mm = 1e4f}, 0, 1e6f);
  ASSERT_EQ(wide.size(), 2u);
  EXPECT_THAT(wide[0], testing::HasSubstr("2.5"));  // degrees: all of the vergence on the screen
  EXPECT_THAT(wide[1], testing::HasSubstr("90 mm behind the screen is larger"));
}

TEST(Comfort, AwayFromTheDeskBroadcastersRulesHold) {
  // A 1200 mm television from 3 m: 1 % of its width, 12 mm, before and 2 %, 24 mm, behind.
  const ViewingGeometry television{.viewing_distance_mm = 3000, .screen_width_mm = 1200};
  const float near_mm = -perceived_depth_mm(television, -12);
  const float far_mm = perceived_depth_mm(television, 24);
  EXPECT_TRUE(discomforts(television, near_mm, far_mm).empty());
  EXPECT_FLOAT_EQ(total_parallax_percent(television, near_mm, far_mm), 3);
  const auto before = discomforts(television, near_mm * 1.1f, far_mm);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_THAT(before[0],
              testing::HasSubstr("1.1 % of the width in front of and 2.0 % behind the screen, 3.1 % in all"));
  EXPECT_EQ(discomforts(television, near_mm, far_mm * 1.1f).size(), 1u);
}

TEST(Comfort, APointBehindTheViewerIsSaidAndNothingElse) {
  const auto found = discomforts({.viewing_distance_mm = 700}, 700, 5000);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0], testing::HasSubstr("behind the viewer"));
}

TEST(Comfort, AngularDisparityIsTheDifferenceOfVergences) {
  const ViewingGeometry viewing{.eye_separation_mm = 65, .viewing_distance_mm = 700};
  const double degrees = (2 * std::atan(32.5 / 600) - 2 * std::atan(32.5 / 700)) * 180 / M_PI;
  EXPECT_NEAR(angular_disparity_deg(viewing, -100), degrees, 1e-4);
  EXPECT_LT(angular_disparity_deg(viewing, 100), 0);
}

TEST(ViewPosition, IsNoNumberButDiffersByOne) {
  static_assert(!std::is_convertible_v<float, ViewPosition> && !std::is_convertible_v<ViewPosition, float>);
  EXPECT_EQ(right_eye - left_eye, 1);
  EXPECT_EQ(left_eye - central_view, -0.5f);
  EXPECT_LT(left_eye, central_view);
  EXPECT_EQ(ViewPosition(0.5), right_eye);
  EXPECT_EQ(ViewPosition(), central_view);
}

TEST(Rig, ViewsAreEvenlySpacedAroundTheCentre) {
  EXPECT_EQ(evenly_spaced(4, 3, 5, 2).positions,
            (std::vector<ViewPosition>{ViewPosition(-1.), left_eye, central_view, right_eye, ViewPosition(1.)}));
  EXPECT_EQ(evenly_spaced(4, 3, 1).positions, (std::vector<ViewPosition>{central_view}));
  EXPECT_EQ(evenly_spaced(4, 3, 2).positions, (std::vector<ViewPosition>{left_eye, right_eye}));
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

}  // namespace wheatstone::viewing_test
