// Views beside the eyes, made from two photographs.

#include "wheatstone/stereo/outer_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/still_life.h"
#include "scenes/two_surfaces.h"

namespace wheatstone::outer_view_test {

using test_scene::square_disparity, test_scene::wall_disparity;

View outer_at(float position, float zero_parallax_px = 0) {
  const StereoPair photographs = test_scene::photographs();
  const StereoGeometry geometry = test_scene::geometry();
  return make_outer_view(scene_from_left(photographs, geometry), ViewPosition(position), zero_parallax_px);
}

/// The column of an outer view that shows what the left eye shows at a column.
int column_in(const View& outer, float left_column, float disparity) {
  return static_cast<int>(std::floor(left_column - (outer.position - left_eye) * disparity)) - outer.frame.origin_px;
}

TEST(OuterView, ShowsWhatThePhotographsShowAndTellsWhatTheyDoNot) {
  const StereoPair photographs = test_scene::photographs();
  const View outer = outer_at(1.5f);
  constexpr int y = 60, square_middle = (test_scene::square_left + test_scene::square_right) / 2;
  const int square = column_in(outer, square_middle + 0.5f, square_disparity);
  EXPECT_EQ(outer.colour(square, y), photographs.left(square_middle, y));
  EXPECT_EQ(outer.disparity(square, y), square_disparity);
  EXPECT_EQ(outer.wanted(square, y), 0);
  const int wall = column_in(outer, 130.5f, wall_disparity);
  EXPECT_EQ(outer.colour(wall, y), photographs.left(130, y));
  EXPECT_EQ(outer.wanted(wall, y), 0);
  // The right eye sees the wall up to the square's right end; from 1 eye separation farther a strip of it more.
  const int square_end = column_in(outer, test_scene::square_right + 0.5f, square_disparity);
  constexpr auto strip = static_cast<int>(square_disparity - wall_disparity);
  int uncovered = 0;
  for (int x = square_end; x < square_end + 2 * strip; ++x) uncovered += outer.wanted(x, y) != 0 ? 1 : 0;
  EXPECT_EQ(uncovered, strip);
  for (int x = square_end; x < square_end + strip; ++x) EXPECT_EQ(outer.wanted(x, y), 255) << x;
}

TEST(OuterView, TheFartherSurfaceGoesOnInWhatIsUncovered) {
  for (const float position : {-2.5f, -1.5f, 1.5f, 2.5f}) {
    const View outer = outer_at(position);
    int uncovered = 0;
    for (int y = test_scene::square_top + 2; y < test_scene::square_bottom - 2; ++y) {
      for (int x = 0; x < test_scene::width; ++x) {
        if (outer.wanted(x, y) == 0) continue;
        ++uncovered;
        EXPECT_EQ(outer.disparity(x, y), wall_disparity);
        EXPECT_GT(outer.colour(x, y).b, outer.colour(x, y).r) << "the wall is blue";
      }
    }
    EXPECT_GT(uncovered, 50 * 12);
  }
}

TEST(OuterView, NoEyeWouldSeeWhatItContinues) {
  const SyntheticStill& still = still_life(320, 240);
  for (const float position : {-2.5f, 0.f, 2.5f}) {
    const View outer = make_outer_view(scene_from_left(still.pictures, still.geometry), ViewPosition(position), 0);
    int uncovered = 0, seen = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        if (outer.wanted(x, y) == 0) continue;
        ++uncovered;
        const float disparity = outer.disparity(x, y);
        ASSERT_FALSE(std::isnan(disparity));
        const auto is_seen = [&](ViewPosition eye, const Image<float>& nearest) {
          const int column = static_cast<int>(
              std::floor(static_cast<float>(x + outer.frame.origin_px) + 0.5f - (eye - outer.position) * disparity));
          return nearest.contains(column, y) && nearest(column, y) < disparity - 2;
        };
        seen += is_seen(left_eye, still.geometry.left_disparity) || is_seen(right_eye, still.geometry.right_disparity);
      }
    }
    EXPECT_GT(uncovered, position == 0 ? 10 : 1000) << position;
    EXPECT_LT(seen, uncovered / 20) << position;
  }
}

TEST(OuterView, StandsWhereADisplayShowsIt) {
  const View there = outer_at(2.5f, 10), here = outer_at(2.5f, 0);
  EXPECT_EQ(here.frame.origin_px, 0);
  EXPECT_EQ(there.frame.origin_px, -25);
  for (int y = 0; y < test_scene::height; ++y)
    for (int x = 25; x < test_scene::width; ++x) {
      if (here.wanted(x - 25, y) != 0 || there.wanted(x, y) != 0) continue;
      ASSERT_EQ(there.colour(x, y), here.colour(x - 25, y)) << x << "," << y;
    }
}

TEST(OuterView, BetweenTheEyesAlmostNothingIsUncovered) {
  const View centre = outer_at(0);
  int inside = 0;
  for (int y = 0; y < test_scene::height; ++y)
    for (int x = 20; x < test_scene::width - 20; ++x) inside += centre.wanted(x, y) != 0 ? 1 : 0;
  EXPECT_EQ(inside, 0);
}

}  // namespace wheatstone::outer_view_test
