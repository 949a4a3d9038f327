// Paint texture: the relief of the strokes and its light.

#include "wheatstone/drawing/relief.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/relief_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::relief_test {

StrokePainting one_stroke(float disparity) {
  Layer layer;
  layer.radius_px = 8;
  layer.points = {{30.5f, 20.5f, disparity}, {50.5f, 20.5f, disparity}, {70.5f, 24.5f, disparity}};
  layer.strokes.push_back({.point_count = 3, .radius_px = 8, .colour = {90, 90, 90}, .disparity = disparity});
  return {100, 48, {255, 255, 255}, {layer}};
}

TEST(Relief, MovesWithItsStroke) {
  const PreparedStrokes painting = prepare_marks(one_stroke(12));
  const Image<float> left = relief_of(painting, left_eye), right = relief_of(painting, right_eye);
  float highest = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 12; x < 100; ++x) {
      EXPECT_NEAR(left(x, y), right(x - 12, y), 1e-4f);
      highest = std::max(highest, left(x, y));
    }
  }
  EXPECT_GT(highest, 0.4f);
  EXPECT_EQ(left(5, 5), 0);
}

TEST(Relief, StandsUpWhereTheStreaksOfABrushAreLighter) {
  StrokePainting strokes = one_stroke(0);
  strokes.layers.front().radius_px = strokes.layers.front().strokes.front().radius_px = 16;
  strokes.brush = {.bristle_px = 2, .streaks = 40};
  const Image<float> relief = relief_of(prepare_marks(strokes), left_eye, {}, strokes.brush.bristle_px);
  const Image<Rgb8> drawn = draw(prepare({.marks = strokes}), left_eye).picture;
  double heights = 0, levels = 0, both = 0, heights_squared = 0, levels_squared = 0, count = 0;
  for (int x = 40; x < 60; ++x) {
    for (int y = 16; y < 26; ++y, ++count) {
      const double height = relief(x, y), level = drawn(x, y).g;
      heights += height;
      levels += level;
      both += height * level;
      heights_squared += height * height;
      levels_squared += level * level;
    }
  }
  const double covariance = both - heights * levels / count;
  const double spread =
      std::sqrt((heights_squared - heights * heights / count) * (levels_squared - levels * levels / count));
  EXPECT_GT(covariance / spread, 0.9);
}

TEST(Relief, LightLeavesFlatPaintAndBareCanvasAlone) {
  Image<Rgb8> picture(20, 10, {10, 120, 250});
  const Image<Rgb8> before = picture;
  light_relief(Image<float>(20, 10, 0.7f), 2, picture);
  EXPECT_EQ(picture, before);
}

TEST(Relief, IsBrighterOnTheSideOfTheLamp) {
  Image<Rgb8> picture(21, 21, {100, 100, 100});
  Image<float> hill(21, 21);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 21; ++x)
      hill(x, y) = std::max(1 - std::hypot(static_cast<float>(x - 10), static_cast<float>(y - 10)) / 8, 0.f);
  light_relief(hill, 4, picture);
  EXPECT_GT(picture(7, 7).g, 105);
  EXPECT_LT(picture(13, 13).g, 95);
}

TEST(Relief, TexturedStrokesFuseWhereIndependentEyesDoNot) {
  const auto paint_scene = [](Propagation propagation) {
    Style style;
    style.absolute_radii = style.texture = true;
    style.propagation = propagation;
    return paint(test_scene::photographs(), test_scene::geometry(), style);
  };
  const auto difference = [](const PaintedPair& painted) {
    return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
  };
  const PaintedPair textured = paint_scene(Propagation::strokes);
  EXPECT_LT(difference(textured), 0.35 * difference(paint_scene(Propagation::independent)));
  EXPECT_LT(textured.right_bare_share, 0.005);
  const StereoPair photographs = test_scene::photographs();
  const auto left_without = [&](bool relief) {
    return draw(prepare(textured.painting, {.relief = relief}), left_eye, photographs.left).picture;
  };
  EXPECT_EQ(textured.pictures.left, left_without(true));
  EXPECT_NE(textured.pictures.left, left_without(false));
}

TEST(Relief, GivesTheSameBytesOnAnyNumberOfThreads) {
  Style style;
  style.absolute_radii = true;
  const Painting painted = paint(test_scene::photographs(), test_scene::geometry(), style).painting;
  const SeenSurfaces seen =
      seen_surfaces(Surfaces(painted.surfaces), right_eye, {test_scene::width, 0, test_scene::height});
  Image<float> first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Image<float> relief =
        relief_of(prepare_marks(std::get<StrokePainting>(painted.marks)), right_eye, seen.hiding);
    if (first.empty()) first = relief;
    EXPECT_EQ(relief, first);
  }
}

}  // namespace wheatstone::relief_test
