#include "wheatstone/stereo/geometry_from_disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone::geometry_test {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr int width = 100, height = 6;

/// A wall of disparity 2 with a post of disparity 12 before it, columns 40 to 59 of the left view.
Image<float> post() {
  Image<float> disparity(width, height, 2);
  for (int y = 0; y < height; ++y)
    for (int x = 40; x < 60; ++x) disparity(x, y) = 12;
  return disparity;
}

const GeometryOptions exact{.least_occlusion_px = 1};

TEST(Geometry, OfAStepIsExact) {
  const StereoGeometry geometry = geometry_from_left(post(), exact);
  for (int x = 0; x < width; ++x) {
    // The post stands at columns 28 to 47 of the right view.
    EXPECT_EQ(geometry.right_disparity(x, 3), x >= 28 && x < 48 ? 12 : 2) << x;
    // The wall left of the post is hidden from the right eye; two columns fall out of its picture.
    EXPECT_EQ(geometry.left_occlusion(x, 3) != 0, x < 2 || (x >= 30 && x < 40)) << x;
    // The wall right of the post is hidden from the left eye, and two columns are outside.
    EXPECT_EQ(geometry.right_occlusion(x, 3) != 0, x >= 98 || (x >= 48 && x < 58)) << x;
  }
}

TEST(Geometry, OfAStepIsTheSameFromBothViews) {
  const StereoGeometry left = geometry_from_left(post(), exact);
  const StereoGeometry both = geometry_from_both(post(), left.right_disparity, exact);
  EXPECT_EQ(both.left_occlusion, left.left_occlusion);
  EXPECT_EQ(both.right_occlusion, left.right_occlusion);
}

TEST(Geometry, WorksWithNegativeDisparities) {
  Image<float> disparity = post();
  for (float& d : disparity.pixels()) d -= 7;
  const StereoGeometry geometry = geometry_from_left(disparity, exact);
  for (int x = 0; x < width; ++x) {
    EXPECT_EQ(geometry.right_disparity(x, 3), x >= 35 && x < 55 ? 5 : -5) << x;
    EXPECT_EQ(geometry.left_occlusion(x, 3) != 0, x >= 95 || (x >= 30 && x < 40)) << x;
  }
}

TEST(Warp, LeavesNoCracksInASurfaceThatItStretches) {
  Image<float> disparity(width, 1);
  for (int x = 0; x < width; ++x)
    disparity(x, 0) = 40 - 0.4f * static_cast<float>(x);  // 1.4 times as wide on the right
  const Image<float> warped = warp_disparity(disparity, left_eye, right_eye);
  for (int x = 0; x < width; ++x) {
    // x_right = 1.4·x_left − 40, at pixel centres
    const float x_left = (static_cast<float>(x) + 0.5f - 0.5f + 40) / 1.4f;
    if (x_left > 1 && x_left < width - 2) {
      EXPECT_NEAR(warped(x, 0), 40 - 0.4f * x_left, 0.25f) << x;
    }
  }
}

TEST(Warp, CarriesAPictureWithItsDisparity) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = {static_cast<std::uint8_t>(2 * x), 0, 0};
  const WarpedPicture warped = warp_picture(picture, post(), left_eye, right_eye);
  EXPECT_EQ(warped.picture(30, 2).r, 2 * 42);
  EXPECT_EQ(warped.picture(70, 2).r, 2 * 72);
  EXPECT_EQ(warped.covered(50, 2), 0) << "only the right eye sees this";
  EXPECT_EQ(warped.covered(70, 2), 255);
}

TEST(Warp, ThereAndBackIsTheSame) {
  Image<float> disparity = post();
  const Image<float> back = warp_disparity(warp_disparity(disparity, left_eye, right_eye), right_eye, left_eye);
  const StereoGeometry geometry = geometry_from_left(post(), exact);
  for (int x = 0; x < width; ++x) {
    if (geometry.left_occlusion(x, 3) == 0) {
      EXPECT_EQ(back(x, 3), disparity(x, 3)) << x;
    }
  }
}

TEST(Filling, TakesTheFartherSide) {
  Image<float> disparity = post();
  for (int x = 55; x < 70; ++x) disparity(x, 3) = unknown;
  fill_from_farther_side(disparity);
  EXPECT_EQ(disparity(55, 3), 2);
  EXPECT_EQ(disparity(54, 3), 12);
}

TEST(Filling, TakesTheNearestRowThatKnowsAnything) {
  Image<float> disparity(width, 5, unknown);
  disparity(7, 1) = 3;
  fill_from_farther_side(disparity);
  for (const float d : disparity.pixels()) EXPECT_EQ(d, 3);
}

TEST(Filling, RefusesADisparityThatKnowsNothing) {
  Image<float> disparity(width, 5, unknown);
  EXPECT_THROW(fill_from_farther_side(disparity), Error);
}

TEST(Geometry, HasNoUnknownsLeftWhateverComesIn) {
  Image<float> disparity = post();
  disparity(3, 3) = std::numeric_limits<float>::infinity();
  disparity(4, 3) = -std::numeric_limits<float>::infinity();
  for (int x = 30; x < 80; ++x) disparity(x, 4) = unknown;
  const StereoGeometry geometry = geometry_from_left(disparity);
  for (const float d : geometry.left_disparity.pixels()) EXPECT_TRUE(std::isfinite(d));
  for (const float d : geometry.right_disparity.pixels()) EXPECT_TRUE(std::isfinite(d));
}

TEST(Geometry, RefusesViewsOfDifferentSizes) {
  EXPECT_THROW(geometry_from_both(Image<float>(3, 3, 1), Image<float>(4, 3, 1)), Error);
}

TEST(Occlusion, GrowsByItsRadius) {
  Image<std::uint8_t> mask(21, 21);
  mask(10, 10) = 255;
  const Image<std::uint8_t> grown = dilate_occlusion(mask, 3);
  EXPECT_EQ(grown(7, 13), 255);
  EXPECT_EQ(grown(6, 10), 0);
  EXPECT_EQ(dilate_occlusion(mask, 0), mask);
}

TEST(Occlusion, LosesItsSpecksOnly) {
  Image<std::uint8_t> mask(30, 30);
  mask(2, 2) = 255;
  for (int y = 10; y < 20; ++y) mask(15, y) = 255;
  remove_occlusion_specks(mask, 5);
  EXPECT_EQ(mask(2, 2), 0);
  EXPECT_EQ(mask(15, 12), 255);
}

TEST(Occlusion, LosesWhatOpenCvFindsToBeSmall) {
  for (const int percent : {3, 20, 35, 50, 70}) {
    Image<std::uint8_t> mask(97, 61);
    cv::RNG random(7);
    for (std::uint8_t& value : mask.pixels()) value = random.uniform(0, 100) < percent ? 255 : 0;
    constexpr int least_px = 7;
    cv::Mat labels, facts, centres;
    cv::connectedComponentsWithStats(as_mat(mask), labels, facts, centres, 8);
    Image<std::uint8_t> expected = mask;
    for (int y = 0; y < mask.height(); ++y)
      for (int x = 0; x < mask.width(); ++x)
        if (facts.at<int>(labels.at<int>(y, x), cv::CC_STAT_AREA) < least_px) expected(x, y) = 0;
    remove_occlusion_specks(mask, least_px);
    EXPECT_EQ(mask, expected) << percent;
  }
}

}  // namespace wheatstone::geometry_test
