#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "wheatstone/calibration/rectify_internal.h"
#include "wheatstone/calibration/rectifying_turn_internal.h"
#include "wheatstone/synthetic/phone_camera.h"

namespace wheatstone::rectifying_turn_test {

constexpr int width = 640, height = 480;

/// Every tenth pixel with its true partner, as hand-held cameras see them.
std::vector<FeatureMatch> true_matches(std::uint64_t seed, double radial_distortion) {
  const PhonePair pair = make_phone_pair({.width = width, .height = height, .seed = seed, .samples_a_side = 1},
                                         {.radial_distortion = radial_distortion, .noise = 0});
  std::vector<FeatureMatch> matches;
  for (int y = 0; y < height; y += 10)
    for (int x = 0; x < width; x += 10) {
      const double flow_x = static_cast<double>(pair.left_to_right.x(x, y));
      const double flow_y = static_cast<double>(pair.left_to_right.y(x, y));
      if (!std::isnan(flow_x)) matches.push_back({{x + 0.5, y + 0.5}, {x + 0.5 + flow_x, y + 0.5 + flow_y}});
    }
  return matches;
}

TEST(RectifyingTurn, FindsWhatTheLensesBend) {
  // k1 = −0.05 at a focal length of 0.8 widths: the corner, at 0.78 focal lengths, comes in by 0.05 · 0.76².
  for (const std::uint64_t seed : {1, 2}) {
    const std::vector<FeatureMatch> matches = true_matches(seed, -0.05);
    const RectifyingTurn plain = find_rectifying_turn(matches, {width, height});
    const RectifyingTurn radial = find_rectifying_turn(matches, {width, height}, LensModel::radial);
    const VerticalDisparity rows = vertical_disparity(rectified_matches(radial, matches));
    const VerticalDisparity plain_rows = vertical_disparity(rectified_matches(plain, matches));
    EXPECT_NEAR(radial.left.straightening, 0.033, 0.006) << seed;
    EXPECT_LT(rows.percentile_95_px, 0.2) << seed;
    EXPECT_LT(rows.percentile_95_px, 0.8 * plain_rows.percentile_95_px) << seed;
  }
}

TEST(RectifyingTurn, FindsNoDistortionWhereThereIsNone) {
  const std::vector<FeatureMatch> matches = true_matches(1, 0);
  const RectifyingTurn radial = find_rectifying_turn(matches, {width, height}, LensModel::radial);
  EXPECT_NEAR(radial.left.straightening, 0, 0.005);
  EXPECT_LT(vertical_disparity(rectified_matches(radial, matches)).percentile_95_px, 0.2);
}

TEST(RectifyingTurn, TakesOutWhatIsLeftSmoothly) {
  std::vector<FeatureMatch> matches;
  for (int y = 5; y < height; y += 20)
    for (int x = 5; x < width; x += 20) {
      const double u = (x - 320) / 640.0, v = (y - 240) / 640.0;
      matches.push_back({{x + 20.0, y + 3 * u * v + 2 * u * u - 8 * v * v * v}, {static_cast<double>(x), y + 0.0}});
    }
  RectifyingTurn turn{{.width = width, .height = height}, {.width = width, .height = height}};
  const double before = vertical_disparity(rectified_matches(turn, matches)).percentile_95_px;
  settle_rows_smoothly(turn, matches);
  EXPECT_GT(before, 0.5);
  EXPECT_LT(vertical_disparity(rectified_matches(turn, matches)).percentile_95_px, 0.15 * before);
}

TEST(RectifyingMap, GoesThereAndBack) {
  const RectifyingMap map{.width = width,
                          .height = height,
                          .straightening = 0.15,
                          .homography = {1.02, -0.03, 4, 0.02, 0.97, -11, 2e-5, -1e-5, 1},
                          .row_correction = {1, 2, -3, 4, 5, -6, 7, 8, -9, 10}};
  for (const PicturePoint& point : {PicturePoint{0, 0}, {640, 0}, {100, 480}, {320, 240}, {511.5, 77}}) {
    const PicturePoint there = rectified_place(map, point), back = photograph_place(map, there);
    EXPECT_GT(std::hypot(there.x - point.x, there.y - point.y), 1);
    EXPECT_NEAR(back.x, point.x, 1e-3);
    EXPECT_NEAR(back.y, point.y, 1e-3);
  }
}

}  // namespace wheatstone::rectifying_turn_test
