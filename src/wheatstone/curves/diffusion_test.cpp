// Diffusion curves: lines of colour beside edges, and what spreads between them.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::diffusion_test {

PaintedPair paint_scene(Propagation propagation = Propagation::strokes) {
  Style style = style_by_name("diffusion");
  style.absolute_radii = true;
  style.propagation = propagation;
  return paint(test_scene::as_photographed(), test_scene::geometry(), style);
}

double difference_of(const PaintedPair& painted) {
  return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
}

TEST(Diffusion, FusesWhereIndependentEyesDoNot) {
  const double both = difference_of(paint_scene()), independent = difference_of(paint_scene(Propagation::independent));
  RecordProperty("both", std::to_string(both));
  RecordProperty("independent", std::to_string(independent));
  EXPECT_LT(both, 0.35 * independent);
}

TEST(Diffusion, KeepsTheColoursOfTwoSurfacesApart) {
  const PaintedPair painted = paint_scene();
  // Two pixels to either side of the square's left edge, which the right eye sees shifted.
  const auto is_square = [](Rgb8 c) { return c.r > c.b; };
  for (int y = 40; y < 80; ++y) {
    EXPECT_TRUE(is_square(painted.pictures.left(test_scene::square_left + 2, y)));
    EXPECT_FALSE(is_square(painted.pictures.left(test_scene::square_left - 3, y)));
    const int shifted = test_scene::square_left - static_cast<int>(test_scene::square_disparity);
    EXPECT_TRUE(is_square(painted.pictures.right(shifted + 2, y)));
    EXPECT_FALSE(is_square(painted.pictures.right(shifted - 3, y)));
  }
}

TEST(Diffusion, GivesTheSameBytesOnAnyNumberOfThreads) {
  PaintedPair first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    PaintedPair painted = paint_scene();
    if (first.pictures.left.empty()) first = painted;
    EXPECT_EQ(painted.painting, first.painting);
    EXPECT_EQ(painted.pictures.right, first.pictures.right);
  }
}

TEST(Diffusion, SpreadsColourEvenlyBetweenTwoLines) {
  DiffusionPainting painting{41, 9, {}, {}};
  for (const float x : {0.5f, 40.5f}) {
    painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()), 3, left_eye, {}});
    const std::uint8_t level = x < 1 ? 40 : 240;
    for (const float y : {0.5f, 4.5f, 8.9f}) painting.points.push_back({{x, y, 0}, {level, level, level}});
  }
  const DrawnView drawn = draw(Painting{painting}, left_eye);
  EXPECT_EQ(drawn.bare_share, 0);
  EXPECT_EQ(drawn.picture(0, 4).r, 40);
  EXPECT_EQ(drawn.picture(40, 4).r, 240);
  for (const int x : {10, 20, 30}) EXPECT_NEAR(drawn.picture(x, 4).r, 40 + 5 * x, 6);
}

TEST(Diffusion, ASoftShadowInACornerIsShown) {
  // Darker towards the lower right, too gradually for an edge; only the square has edges.
  Image<Rgb8> picture(240, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 240; ++x) {
      const int shadow = std::max(x + y - 160, 0) / 2;
      const auto level = static_cast<std::uint8_t>(x > 20 && x < 60 && y > 40 && y < 80 ? 20 : 200 - shadow);
      picture(x, y) = {level, level, level};
    }
  }
  const StereoPair photographs{picture, picture};
  const PaintedPair painted =
      paint(photographs, geometry_from_left(Image<float>(240, 120, 0)), style_by_name("diffusion"));
  EXPECT_LT(measure_wrong_spots(painted.pictures, photographs).share, 0.01);
}

TEST(Diffusion, IsBareWithoutLinesAndPaintsPicturesOfAnySize) {
  EXPECT_EQ(draw(Painting{DiffusionPainting{5, 4, {}, {}}}, left_eye).bare_share, 1);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 7}, {9, 5}}) {
    const StereoPair tiny{Image<Rgb8>(width, height, {9, 99, 199}), Image<Rgb8>(width, height, {9, 99, 199})};
    const PaintedPair painted =
        paint(tiny, geometry_from_left(Image<float>(width, height, 0)), style_by_name("diffusion"));
    EXPECT_EQ(painted.pictures.left, tiny.left);
  }
}

}  // namespace wheatstone::diffusion_test
