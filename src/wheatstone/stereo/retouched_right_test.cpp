// The right picture of a pair whose depth a hand has changed.

#include "wheatstone/stereo/retouched_right.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "wheatstone/random.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone::retouched_right_test {

constexpr int width = 120, height = 40, wall_px = 2, board_px = 10;

/// A board before a wall, which stands in these columns of the left picture.
constexpr int board_left = 50, board_right = 80;

Rgb8 colour_of_board(int x, int y) {
  return {200, static_cast<std::uint8_t>(100 + hash_keys({1, x / 4u, y / 4u}) % 90), 30};
}
Rgb8 colour_of_wall(int x, int y) { return {30, static_cast<std::uint8_t>(hash_keys({2, x / 4u, y / 4u}) % 90), 200}; }

Image<float> left_disparity(int of_board_px) {
  Image<float> disparity(width, height, wall_px);
  for (int y = 0; y < height; ++y)
    for (int x = board_left; x < board_right; ++x) disparity(x, y) = static_cast<float>(of_board_px);
  return disparity;
}

/// What the eyes see of the board where it has this disparity. The wall's columns are those of the left picture.
StereoPair seen(int of_board_px) {
  StereoPair pair{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  const auto is_board = [](int x) { return x >= board_left && x < board_right; };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      pair.left(x, y) = is_board(x) ? colour_of_board(x, y) : colour_of_wall(x, y);
      pair.right(x, y) =
          is_board(x + of_board_px) ? colour_of_board(x + of_board_px, y) : colour_of_wall(x + wall_px, y);
    }
  }
  return pair;
}

StereoGeometry geometry(int of_board_px) { return geometry_from_left(left_disparity(of_board_px)); }

/// Pixels that fit the new depth within this much stay.
bool is_like(Rgb8 a, Rgb8 b) {
  constexpr int levels = 24;
  return std::abs(a.r - b.r) <= levels && std::abs(a.g - b.g) <= levels && std::abs(a.b - b.b) <= levels;
}

TEST(RetouchedRight, StaysWhereAHandCorrectsAWrongDepth) {
  for (const int wrong_px : {board_px - 6, board_px + 6}) {
    SCOPED_TRACE(wrong_px);
    EXPECT_TRUE(retouched_right(seen(board_px), geometry(wrong_px), geometry(board_px)).empty());
  }
}

TEST(RetouchedRight, StaysWhereNothingIsTouched) {
  EXPECT_TRUE(retouched_right(seen(board_px), geometry(board_px), geometry(board_px)).empty());
}

TEST(RetouchedRight, ShowsAThingWhereAHandPutsIt) {
  for (const int put_px : {board_px - 6, board_px + 6}) {
    SCOPED_TRACE(put_px);
    const Image<Rgb8> right = retouched_right(seen(board_px), geometry(board_px), geometry(put_px));
    ASSERT_FALSE(right.empty());
    const Image<Rgb8> wanted = seen(put_px).right;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        // What the board leaves shows the wall, whose columns there nobody has seen.
        const bool is_left_behind = put_px > board_px && x >= board_right - put_px && x < board_right - board_px;
        if (is_left_behind)
          ASSERT_EQ(right(x, y).b, 200) << x << ", " << y;
        else
          ASSERT_TRUE(is_like(right(x, y), wanted(x, y))) << x << ", " << y;
      }
    }
  }
}

}  // namespace wheatstone::retouched_right_test
