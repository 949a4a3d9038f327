#include "wheatstone/matching/confirm_internal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::confirm_test {

constexpr int width = 400, height = 160;
constexpr float wall = 10, fence = 25;

void set(Image<float>& disparity, const cv::Rect& where, float value) { as_mat(disparity)(where).setTo(value); }

/// A wall with a fence before it.
Image<float> fenced_wall() {
  Image<float> disparity(width, height, wall);
  set(disparity, {64, 44, 120, 76}, fence);
  return disparity;
}

/// Around a patch nothing is known, as at the rim of a hole.
void set_patch(Image<float>& disparity, const cv::Rect& patch, float value) {
  set(disparity, {patch.x - 3, patch.y - 3, patch.width + 6, patch.height + 6},
      std::numeric_limits<float>::quiet_NaN());
  set(disparity, patch, value);
}

TEST(RemoveSpecklesButHoles, KeepsWhatIsSeenThroughAFence) {
  Image<float> disparity = fenced_wall();
  set_patch(disparity, {80, 60, 8, 7}, wall);
  Image<float> without = disparity;
  remove_speckles(without, 100);
  ASSERT_TRUE(std::isnan(without(84, 63)));
  remove_speckles_but_holes(disparity, 100);
  for (int y = 60; y < 67; ++y)
    for (int x = 80; x < 88; ++x) EXPECT_EQ(disparity(x, y), wall) << x << " " << y;
  EXPECT_EQ(disparity(120, 100), fence);
}

TEST(RemoveSpeckles, RemovesFromASideLongerThan16BitsCount) {
  constexpr int length = 70000, last = length - 1;
  Image<float> column(2, length, 3), row(length, 2, 3);
  for (Image<float>* strip : {&column, &row}) {
    (*strip)(strip->width() - 1, strip->height() - 1) = 60;
    remove_speckles(*strip, 10);
  }
  EXPECT_TRUE(std::isnan(column(1, last)));
  EXPECT_TRUE(std::isnan(row(last, 1)));
  EXPECT_EQ(column(0, last), 3);
  EXPECT_EQ(row(0, 0), 3);
}

TEST(RemoveSpeckles, KeepsStripesThatAreJoinedFarBelowAndRemovesThoseThatAreNot) {
  constexpr int columns = 60, rows = 300, joined = 40;
  Image<float> disparity(columns, rows, std::numeric_limits<float>::quiet_NaN());
  for (int x = 0; x < columns; x += 2)
    for (int y = x; y < rows; ++y) disparity(x, y) = 5;
  for (int x = 0; x <= joined; ++x) disparity(x, rows - 1) = 5;
  remove_speckles(disparity, rows);  // one stripe has fewer pixels, those that are joined have more
  for (int x = 0; x < columns; x += 2)
    for (const int y : {x, 150, rows - 1}) EXPECT_EQ(disparity(x, y) == 5, x <= joined) << x << " " << y;
}

TEST(RemoveSpeckles, LeavesInfiniteDisparities) {
  Image<float> disparity(3, 3, std::numeric_limits<float>::infinity());
  remove_speckles(disparity, 100);
  EXPECT_EQ(disparity(1, 1), std::numeric_limits<float>::infinity());
}

TEST(RemoveSpecklesButHoles, RemovesWhatCanBeNoHole) {
  Image<float> disparity = fenced_wall();
  set_patch(disparity, {80, 60, 8, 7}, fence + 10);  // nearer than what is around it
  set_patch(disparity, {110, 60, 8, 7}, wall - 6);   // farther than all
  set_patch(disparity, {140, 60, 5, 5}, wall);       // too small
  set_patch(disparity, {20, 60, 8, 7}, wall + 6);    // before the wall
  remove_speckles_but_holes(disparity, 100);
  for (const int x : {83, 113, 142, 23}) EXPECT_TRUE(std::isnan(disparity(x, 62))) << x;
}

TEST(UnknownPlaces, AreAllThatAreNaN) {
  Image<float> disparity(37, 5, 3);
  disparity(1, 1) = disparity(20, 2) = disparity(36, 4) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(cv::countNonZero(unknown_places(as_mat(disparity))), 3);
}

}  // namespace wheatstone::confirm_test
