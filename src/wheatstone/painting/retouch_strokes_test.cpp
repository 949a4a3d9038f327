// Strokes that are painted, erased and recoloured by hand.

#include "wheatstone/painting/retouch_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "scenes/still_life.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone::retouch_strokes_test {

constexpr Rgb8 green{20, 220, 30};

const SyntheticStill& still() { return still_life(240, 180); }

const Painting& painting() {
  static const Painting planned = plan_painting(still().pictures, still().geometry, style_by_name("oil"));
  return planned;
}

Painting retouched(const std::vector<Touch>& touches, Painting of = painting()) {
  retouch_strokes(touches, of);
  return of;
}

std::size_t count_in(const Painting& of) {
  std::size_t count = 0;
  for (const Layer& layer : layers_of(of)) count += layer.strokes.size();
  return count;
}

/// A stroke of the hand over the wall and what stands before it.
std::vector<Touch> across(Retouch kind, float radius_px) {
  std::vector<Touch> touches;
  for (float x = 60; x <= 180; x += 10)
    touches.push_back(
        {.kind = kind, .x = x, .y = 70, .radius_px = radius_px, .colour = green, .goes_on = !touches.empty()});
  return touches;
}

bool is_green(Rgb8 pixel) { return pixel.g > pixel.r + 60 && pixel.g > pixel.b + 60; }

/// The columns of a row of a picture that are green.
std::vector<int> green_columns(const Image<Rgb8>& picture, int y) {
  std::vector<int> columns;
  for (int x = 0; x < picture.width(); ++x)
    if (is_green(picture(x, y))) columns.push_back(x);
  return columns;
}

TEST(RetouchStrokes, WhatIsPaintedLiesOnTheSurfaceInBothEyes) {
  const Presented eyes = present(retouched(across(Retouch::paint, 6)), for_two_eyes());
  const std::vector<int> left = green_columns(eyes.views.front(), 70), right = green_columns(eyes.views.back(), 70);
  ASSERT_GT(left.size(), 70u);  // the brush runs dry before the end
  ASSERT_GT(right.size(), 60u);
  const Image<float>& disparity = still().geometry.left_disparity;
  int on_surface = 0, beside_edges = 0;
  for (const int x : left) {
    if (std::abs(disparity(x + 8, 70) - disparity(x - 8, 70)) < 2) {
      const auto in_right = static_cast<int>(std::lround(static_cast<float>(x) - disparity(x, 70)));
      on_surface += is_green(eyes.views.back()(in_right, 70)) ? 1 : 0;
    } else {
      ++beside_edges;
    }
  }
  EXPECT_LT(beside_edges, 40);
  EXPECT_GT(on_surface, 0.97 * static_cast<double>(left.size()) - beside_edges);
  EXPECT_TRUE(green_columns(eyes.views.front(), 100).empty());
}

TEST(RetouchStrokes, OneStrokeOfTheHandIsOneStroke) {
  EXPECT_EQ(count_in(retouched(across(Retouch::paint, 6))), count_in(painting()) + 1);
  std::vector<Touch> two = across(Retouch::paint, 6);
  two[5].goes_on = false;
  EXPECT_EQ(count_in(retouched(two)), count_in(painting()) + 2);
}

TEST(RetouchStrokes, ErasingShowsTheGroundAndNothingBare) {
  const Painting erased = retouched(across(Retouch::erase, 8));
  EXPECT_LT(count_in(erased), count_in(painting()) - 10);
  EXPECT_EQ(layers_of(erased).front(), layers_of(painting()).front());
  EXPECT_LE(present(erased, for_two_eyes()).worst_bare_share, 0.002);
  const Presented before = present(painting(), for_two_eyes()), now = present(erased, for_two_eyes());
  for (const std::size_t eye : {0u, 1u}) {
    const auto differs_in = [&](int y) {
      const auto a = before.views[eye].row(y), b = now.views[eye].row(y);
      return !std::equal(a.begin(), a.end(), b.begin());
    };
    EXPECT_TRUE(differs_in(70)) << eye;
    EXPECT_FALSE(differs_in(150)) << eye;
  }
}

TEST(RetouchStrokes, ASmallBrushTakesHoldOfSmallStrokesOnly) {
  const Painting erased = retouched(across(Retouch::erase, 2));
  for (std::size_t i = 0; i < layers_of(painting()).size(); ++i) {
    if (layers_of(painting())[i].radius_px > 4) {
      EXPECT_EQ(layers_of(erased)[i], layers_of(painting())[i]);
    }
  }
}

TEST(RetouchStrokes, RecolouringKeepsStrokesAndTheirLightAndShade) {
  const Painting now = retouched(across(Retouch::recolour, 8));
  EXPECT_EQ(count_in(now), count_in(painting()));
  int changed = 0;
  bool varies = false;
  for (std::size_t i = 0; i < layers_of(now).size(); ++i) {
    for (std::size_t s = 0; s < layers_of(now)[i].strokes.size(); ++s) {
      const Stroke& stroke = layers_of(now)[i].strokes[s];
      if (stroke == layers_of(painting())[i].strokes[s]) continue;
      ++changed;
      EXPECT_GT(stroke.colour.g, stroke.colour.r);
      varies = varies || stroke.colour != green;
    }
  }
  EXPECT_GT(changed, 10);
  EXPECT_TRUE(varies);
}

TEST(RetouchStrokes, AreKeptInAFile) {
  std::vector<Touch> touches = across(Retouch::erase, 8);
  std::ranges::copy(across(Retouch::paint, 5), std::back_inserter(touches));
  const Painting now = retouched(touches);
  EXPECT_EQ(decode_painting(encode_painting(now), "some.wst"), now);
}

TEST(RetouchStrokes, BesideThePictureDoNothing) {
  EXPECT_EQ(retouched({{.kind = Retouch::paint, .x = -50, .y = -9}, {.kind = Retouch::erase, .x = 9000, .y = 9}}),
            painting());
}

TEST(RetouchStrokes, LeaveDepthAndPaintingsOfOtherMarksAlone) {
  EXPECT_EQ(retouched(across(Retouch::shift, 8)), painting());
  const Painting regions = plan_painting(still().pictures, still().geometry, style_by_name("posterise"));
  EXPECT_FALSE(has_strokes_to_retouch(regions));
  EXPECT_EQ(retouched(across(Retouch::paint, 8), regions), regions);
}

}  // namespace wheatstone::retouch_strokes_test
