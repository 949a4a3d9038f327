// Paintings show no colour that the photographs have nowhere near.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "scenes/painted_frame.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_for_eyes.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::repair_test {

constexpr int width = 160, height = 96;
constexpr Rgb8 dark{40, 40, 40}, light{220, 220, 220}, red{230, 20, 30};

PaintedPair paint_flat(const StereoPair& photographs, const Style& style) {
  return paint(photographs, geometry_from_left(Image<float>(width, height, 0)), style);
}

/// A dark and a light half, and something red.
Image<Rgb8> with_bar(int x, int y, int bar_width, int bar_height) {
  Image<Rgb8> picture(width, height, dark);
  for (int row = 0; row < height; ++row)
    for (int column = width / 2; column < width; ++column) picture(column, row) = light;
  for (int row = y; row < y + bar_height; ++row)
    for (int column = x; column < x + bar_width; ++column) picture(column, row) = red;
  return picture;
}

void expect_right(const PaintedPair& painted, const StereoPair& photographs) {
  EXPECT_LT(measure_wrong_spots(painted.pictures.left, photographs.left).share, 0.002);
  EXPECT_LT(measure_wrong_spots(painted.pictures.right, photographs.right).share, 0.002);
}

TEST(Posterise, IsRightForTheOtherEyeAlsoWhereTheDisparityIsWrong) {
  const StereoPair photographs{with_bar(40, 30, 8, 36), with_bar(28, 30, 8, 36)};
  expect_right(paint_flat(photographs, style_by_name("posterise")), photographs);
}

class RepairedSpots : public testing::TestWithParam<const char*> {};

bool is_red(Rgb8 colour) { return colour.r > 150 && colour.g < 100 && colour.b < 100; }

TEST_P(RepairedSpots, ShowTheOtherEyeWhatItsPhotographShows) {
  // The bar is 12 pixels nearer than the disparities say.
  const StereoPair photographs{with_bar(40, 30, 8, 36), with_bar(28, 30, 8, 36)};
  const Image<Rgb8> right = paint_flat(photographs, style_by_name(GetParam())).pictures.right;
  for (int y = 32; y < 64; y += 4) {
    EXPECT_TRUE(is_red(right(32, y))) << y;
    EXPECT_FALSE(is_red(right(44, y))) << y;
  }
}

TEST_P(RepairedSpots, AreRepairedForTheViewsAboutTheOtherEyeOnly) {
  const StereoPair photographs{with_bar(40, 30, 8, 36), with_bar(28, 30, 8, 36)};
  const Painting painting = paint_flat(photographs, style_by_name(GetParam())).painting;
  const auto has_two_bars = [&](float position) {
    const Image<Rgb8> seen = draw(painting, ViewPosition(position)).picture;
    return is_red(seen(44, 48)) && is_red(seen(32, 48));
  };
  EXPECT_FALSE(has_two_bars(-0.5f));
  EXPECT_FALSE(has_two_bars(0.f));
  EXPECT_FALSE(has_two_bars(0.5f));
}

/// Something near on the left; beside it the right eye sees a red part of what is behind.
TEST_P(RepairedSpots, AreNotOfWhatOnlyTheOtherEyeSees) {
  constexpr int outline = 60, near_px = 16;
  StereoPair photographs{with_bar(0, 0, 0, 0), with_bar(outline - near_px, 0, near_px, height)};
  Image<float> left(width, height, 0), right(width, height, 0);
  for (int y = 0; y < height; ++y) {
    std::fill_n(&left(0, y), outline, float{near_px});
    std::fill_n(&right(0, y), outline, float{near_px});  // as matching has it, which does not know what one eye sees
  }
  const PaintedPair painted =
      paint(photographs, geometry_from_both(std::move(left), std::move(right)), style_by_name(GetParam()));
  for (int y = 16; y < 80; y += 4) {
    EXPECT_TRUE(is_red(painted.pictures.right(outline - near_px / 2, y))) << y;
    for (int x = outline - near_px / 2; x < outline + near_px; x += 4)
      EXPECT_FALSE(is_red(painted.pictures.left(x, y))) << x << ", " << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, RepairedSpots, testing::Values("impressionist", "dual", "posterise", "diffusion"),
                         [](const auto& tested) { return std::string(tested.param); });

/// A soft light that has no edge.
Image<Rgb8> with_glow() {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      constexpr float bright = 80, sigma_px = 16;
      const int right = x - width / 2, below = y - height / 2;
      const float from_middle = std::hypot(static_cast<float>(right), static_cast<float>(below));
      const float added = bright * std::exp(-0.5f * from_middle * from_middle / (sigma_px * sigma_px));
      const auto level = static_cast<std::uint8_t>(80 + added);
      picture(x, y) = {level, level, level};
    }
  return picture;
}

TEST(Diffusion, ShowsALightWithoutEdgesInAllViews) {
  const StereoPair photographs{with_glow(), with_glow()};
  const Painting painting = paint_flat(photographs, style_by_name("diffusion")).painting;
  for (const float position : {-0.5f, -0.2f, 0.f, 0.5f, 1.f})
    EXPECT_EQ(measure_wrong_spots(draw(painting, ViewPosition(position)).picture, photographs.left).share, 0)
        << position;
}

TEST(Diffusion, ShowsALightWithoutEdgesInAFilm) {
  const StereoPair photographs{with_glow(), with_glow()};
  const StereoGeometry geometry = geometry_from_left(Image<float>(width, height, 0));
  const CentralView centre = make_central_view(photographs, geometry);
  const std::vector<View> views = scene_from_centre(centre, photographs, geometry);
  PaintingMemory nothing_before;
  const std::vector<Image<Rgb8>> eyes =
      paint_frame(FilmFrame{.views = views}, style_by_name("diffusion"), {}, nothing_before).shown.views;
  EXPECT_EQ(measure_wrong_spots({eyes[0], eyes[1]}, photographs).share, 0);
}

TEST(FrameOfStrokes, ShowsTheEyesNoColourThatTheyDoNotHave) {
  SyntheticFilmOptions film{.still = {.width = 320, .height = 180, .samples_a_side = 2}, .frames = 2};
  film.scene = FilmScene::beams;
  const SyntheticFilmFrame frame = make_synthetic_film_frame(film, 0);
  const CentralView centre = make_central_view(frame.pictures, frame.geometry);
  const std::vector<View> views = scene_from_centre(centre, frame.pictures, frame.geometry);
  const Style style = style_by_name("impressionist");
  PaintingMemory nothing_before;
  const Painting planned = plan_frame(FilmFrame{.views = views}, style, {}, nothing_before).painting;
  EXPECT_GT(measure_wrong_spots(draw(planned, left_eye).picture, frame.pictures.left).share, 0);
  nothing_before = {};
  const PlannedFrame repaired = plan_for_eyes(FilmFrame{.views = views}, style, {}, nothing_before);
  const auto& [left, right] = std::tie(repaired.drawn.at(0), repaired.drawn.at(1));
  EXPECT_EQ(measure_wrong_spots({left.picture, right.picture}, frame.pictures).share, 0);
  // What repairs the pictures belongs to the painting, and what was drawn to plan it is what is drawn of it.
  const PreparedPainting prepared = prepare(repaired.painting);
  EXPECT_EQ(draw(prepared, left_eye, frame.pictures.left).picture, left.picture);
  EXPECT_EQ(draw(prepared, right_eye, frame.pictures.right).picture, right.picture);
}

TEST(Posterise, KeepsColoursForSmallThingsOfTheirOwn) {
  Image<Rgb8> picture(320, 160);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const auto level = static_cast<std::uint8_t>(20 + x * 210 / 320);
      picture(x, y) = {level, static_cast<std::uint8_t>(y), level};
    }
  for (int y = 60; y < 66; ++y) std::fill_n(&picture(90, y), 6, Rgb8{20, 250, 20});
  const Image<float> flat(320, 160, 0);
  const PaintedPair painted = paint({picture, picture}, geometry_from_left(flat), style_by_name("posterise"));
  const Rgb8 dot = painted.pictures.left(93, 63);
  EXPECT_LT(std::hypot(dot.r - 20, dot.g - 250, dot.b - 20), unlike_colours);
}

}  // namespace wheatstone::repair_test
