#include "wheatstone/drawing/hidden_strokes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "wheatstone/drawing/draw.h"

namespace wheatstone::hidden_strokes_test {

constexpr int width = 40, height = 20;
constexpr Rgb8 red{200, 0, 0}, blue{0, 0, 200};

void add_dot(float x, float disparity, float radius_px, Rgb8 colour, Layer& layer) {
  layer.strokes.push_back({.first_point = static_cast<std::uint32_t>(layer.points.size()),
                           .point_count = 1,
                           .radius_px = radius_px,
                           .colour = colour,
                           .disparity = disparity,
                           .views = all_views});
  layer.points.push_back({x, height / 2.f, disparity});
}

TEST(HiddenStrokes, AreThoseThatNoViewShowsOfTheirLayer) {
  StrokePainting painting{.width = width, .height = height, .layers = {{}, {}}};
  Layer& coarse = painting.layers[0];
  Layer& fine = painting.layers[1];
  add_dot(10, 0, 3, red, coarse);  // hidden by the finer layer alone: stays
  add_dot(30, 0, 2, red, coarse);  // wholly behind the next
  add_dot(30, 0, 5, blue, coarse);
  add_dot(10, 0, 6, blue, fine);
  add_dot(20, 0, 2, red, fine);  // only some views look past the next
  add_dot(20, 8, 4, blue, fine);
  const std::array views{left_eye, right_eye};
  const StrokePainting kept = without_hidden_strokes(painting, {}, views, 1.f / 128);
  ASSERT_EQ(kept.layers[0].strokes.size(), 2u);
  EXPECT_EQ(kept.layers[0].strokes[0].colour, red);
  EXPECT_EQ(kept.layers[0].strokes[1].colour, blue);
  EXPECT_EQ(kept.layers[1].strokes.size(), 3u);
  EXPECT_EQ(without_hidden_strokes(painting, {}, std::array{left_eye}, 1.f / 128).layers[1].strokes.size(), 2u);
  for (const ViewPosition view : views)
    EXPECT_EQ(draw(Painting{kept}, view).picture, draw(Painting{painting}, view).picture);
}

/// A stroke from the left to the right.
void add_line(float radius_px, Rgb8 colour, Layer& layer) {
  add_dot(4, 0, radius_px, colour, layer);
  for (const float x : {12.f, 20.f, 28.f, 36.f}) layer.points.push_back({x, height / 2.f, 0});
  layer.strokes.back().point_count = 5;
}

TEST(HiddenStrokes, LeaveTheBristlesOfTheOthersAsTheyAre) {
  StrokePainting painting{.width = width, .height = height, .layers = {{}}, .brush = {.bristle_px = 1, .streaks = 60}};
  Layer& layer = painting.layers[0];
  add_dot(20, 0, 2, red, layer);  // wholly behind the next
  add_line(6, blue, layer);
  const StrokePainting kept = without_hidden_strokes(painting, {}, std::array{left_eye}, 1.f / 128);
  ASSERT_EQ(kept.layers[0].strokes.size(), 1u);
  EXPECT_EQ(draw(Painting{kept}, left_eye).picture, draw(Painting{painting}, left_eye).picture);
}

TEST(HiddenStrokes, AreNotThoseThatShowWhereABrushRunsDry) {
  StrokePainting painting{.width = width, .height = height, .layers = {{}}, .brush = {.bristle_px = 1, .dry = 1}};
  add_dot(34, 0, 2, red, painting.layers[0]);
  add_line(5, blue, painting.layers[0]);
  EXPECT_EQ(without_hidden_strokes(painting, {}, std::array{left_eye}, 1.f / 128).layers[0].strokes.size(), 1u)
      << "the coarsest layer does not run dry";
  painting.layers.insert(painting.layers.begin(), Layer{});
  EXPECT_EQ(without_hidden_strokes(painting, {}, std::array{left_eye}, 1.f / 128).layers[1].strokes.size(), 2u);
}

}  // namespace wheatstone::hidden_strokes_test
