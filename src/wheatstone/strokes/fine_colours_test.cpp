#include "wheatstone/strokes/fine_colours_internal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wheatstone::fine_colours_test {

/// Rows of one colour each, in levels: what a stroke that lies in a row is to become.
template <class LevelOfColumn>
Image<Rgb16> picture_of(int width, int height, LevelOfColumn level) {
  Image<Rgb16> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto code = static_cast<std::uint16_t>(std::lround(level(x) * deep_level));
      picture(x, y) = {code, code, code};
    }
  return picture;
}

/// A stroke from (20, 20) to (60, 20).
Layer one_stroke(std::uint8_t level, ColourChange change, std::uint32_t number) {
  Layer layer;
  layer.points = {{20, 20, 4}, {40, 20, 4}, {60, 20, 4}};
  layer.strokes.push_back({.point_count = 3,
                           .radius_px = 6,
                           .colour = {level, level, level},
                           .reference_view = central_view,
                           .number = number,
                           .change = change});
  return layer;
}

constexpr int third = 43;  // of 128 steps a level

TEST(FineColours, AreWhatEightBitsLeaveOutOfPlainPlaces) {
  const Image<Rgb16> picture = picture_of(80, 40, [](int) { return 100 + 1. / 3; });
  Layer layer = one_stroke(100, {}, 7);
  refine_colours({picture}, 6, layer);
  const FineColour expected{{third, third, third}, {third, third, third}};
  EXPECT_EQ(layer.strokes[0].fine, expected);
  Layer above = one_stroke(101, {}, 7);
  refine_colours({picture}, 6, above);
  EXPECT_EQ(above.strokes[0].fine.begin[0], third - 128);
  Layer enlarged = one_stroke(100, {}, 7);
  refine_colours({picture_of(160, 80, [](int) { return 100 + 1. / 3; }), 2}, 6, enlarged);
  EXPECT_EQ(enlarged.strokes[0].fine, expected);
}

TEST(FineColours, AreNoneWhereTheStrokeHasAnotherColour) {
  const Image<Rgb16> picture = picture_of(80, 40, [](int) { return 100 + 1. / 3; });
  for (const int level : {97, 98, 103}) {
    Layer layer = one_stroke(static_cast<std::uint8_t>(level), {}, 7);
    refine_colours({picture}, 6, layer);
    EXPECT_EQ(layer.strokes[0].fine, FineColour()) << level;
  }
}

TEST(FineColours, OfStrokesThatAreCarriedStay) {
  const Image<Rgb16> picture = picture_of(80, 40, [](int) { return 100 + 1. / 3; });
  Layer layer = one_stroke(100, {}, 7);
  layer.strokes[0].fine.begin = {9, 9, 9};
  refine_colours({picture}, 7, layer);
  EXPECT_EQ(layer.strokes[0].fine.begin[0], 9);
}

TEST(FineColours, FollowAColourThatChangesAlongTheStroke) {
  // The left eye sees the stroke two columns to the right: 102.2 where it begins, 106.2 where it ends.
  const Image<Rgb16> picture = picture_of(80, 40, [](int x) { return 100 + (x + 0.5) / 10; });
  Layer layer = one_stroke(102, {4, 4, 4}, 7);
  refine_colours({picture}, 0, layer);
  EXPECT_NEAR(layer.strokes[0].fine.begin[0], 0.2 * 128, 2);
  EXPECT_NEAR(layer.strokes[0].fine.end[0], 0.2 * 128, 2);
}

TEST(FineColours, OfStrokesBesideThePictureAreNone) {
  const Image<Rgb16> picture = picture_of(10, 10, [](int) { return 100; });
  Layer layer = one_stroke(100, {}, 7);
  refine_colours({picture}, 6, layer);
  EXPECT_EQ(layer.strokes[0].fine, FineColour());
}

}  // namespace wheatstone::fine_colours_test
