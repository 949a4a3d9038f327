// Keyframes of a camera.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "throws_error.h"
#include "wheatstone/app/camera_path.h"

namespace wheatstone::camera_path_test {

constexpr auto path_text = R"(
[[key]]
at = 0
azimuth = 30
zoom = 1
centre = [0, 10, 20]

[[key]]
at = 0.5
azimuth = 90

[[key]]
at = 1
azimuth = 60
zoom = 16
centre = [4, 10, 10.5]
)";

TEST(CameraPath, PassesThroughItsKeysAndRestsAtTheEnds) {
  const CameraPath path = parse_camera_path(path_text, "path.toml");
  EXPECT_DOUBLE_EQ(*camera_at(path, 0).azimuth_deg, 30);
  EXPECT_DOUBLE_EQ(*camera_at(path, 0.5).azimuth_deg, 90);
  EXPECT_DOUBLE_EQ(*camera_at(path, 1).azimuth_deg, 60);
  constexpr double little = 1e-4;
  for (const double end : {little, 1 - little})
    EXPECT_NEAR(*camera_at(path, end).azimuth_deg, end < 0.5 ? 30 : 60, 1e-4) << "moves at its end " << end;
  for (double at = 0; at <= 1; at += 0.01) EXPECT_LE(*camera_at(path, at).azimuth_deg, 90) << "swings over at " << at;
}

TEST(CameraPath, ZoomsByFactorsAndLeavesOpenWhatNoKeySays) {
  const CameraKey middle = camera_at(parse_camera_path(path_text, "path.toml"), 0.5);
  EXPECT_NEAR(*middle.zoom, 4, 1e-9);
  EXPECT_THAT(*middle.centre, testing::ElementsAre(2, 10, 15.25));
  EXPECT_FALSE(middle.elevation_deg || middle.time || middle.field_of_view_deg);
}

TEST(CameraPath, IsTheSameFromItsText) {
  const CameraPath path{{{.at = 0, .azimuth_deg = 1.0 / 3, .zoom = 2, .centre = {{1e8 + 0.1, -1e-12, 0}}},
                         {.at = 0.1, .elevation_deg = -90, .field_of_view_deg = 40, .time = 1e22},
                         {.at = 1}}};
  EXPECT_EQ(parse_camera_path(camera_path_text(path), "path.toml"), path);
}

TEST(CameraPath, RefusesWhatItDoesNotKnowInOneLine) {
  const auto refused = [](const std::string& toml, const std::string& message) {
    expect_error(ErrorKind::bad_input, message, [&] { parse_camera_path(toml, "path.toml"); });
  };
  refused("[[key]]\nat = 0\nazimut = 3", "path.toml: unknown key 'azimut', expected one of at, centre, azimuth");
  refused("[[keys]]\nat = 0", "path.toml: unknown table 'keys', expected [[key]]");
  refused("", "path.toml: has no keyframes");
  refused("[[key]]\nazimuth = 3", "a [[key]] has no 'at'");
  refused("[[key]]\nat = 2", "'at' is not a number from 0 to 1");
  refused("[[key]]\nat = 0\nzoom = nan", "'zoom' is not a number from 0.01 to 1000");
  refused("[[key]]\nat = 0\ntime = inf", "'time' is not a finite number");
  refused("[[key]]\nat = 0\ncentre = [1, 2]", "'centre' is not a point");
  refused("[[key]]\nat = 0\ncentre = [1e300, 2, 3]", "path.toml: 'centre' is not a");
  refused("[[key]]\nat = 0.5\n[[key]]\nat = 0.5", "a keyframe at 0.5 follows one at 0.5");
  refused("[[key]\nat = 0", "path.toml: line 1:");
}

}  // namespace wheatstone::camera_path_test
