// Paintings of any kind of marks: drawn as their kind is, and made larger.

#include "wheatstone/marks/painting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::painting_test {

Style style_of(std::string_view name) {
  Style style = style_by_name(name);
  style.absolute_radii = true;
  style.background = Background::colour;
  style.texture = is_of_strokes(style);
  return style;
}

PaintedPair painted(std::string_view name) {
  return paint(test_scene::photographs(), test_scene::geometry(), style_of(name));
}

double mean_difference(const Image<Rgb8>& small, const Image<Rgb8>& large, int scale) {
  double sum = 0;
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      int level = 0;
      for (int i = 0; i < scale * scale; ++i) level += large(scale * x + i % scale, scale * y + i / scale).g;
      sum += std::abs(small(x, y).g - level / (scale * scale));
    }
  }
  return sum / static_cast<double>(small.pixels().size());
}

TEST(Painting, IsDrawnAsItsKindOfMarksIs) {
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const PaintedPair made = painted(name);
    EXPECT_EQ(draw(made.painting, left_eye).picture, made.pictures.left) << name;
    EXPECT_EQ(draw(made.painting, right_eye).picture, made.pictures.right) << name;
  }
}

TEST(Painting, IsTheSamePictureWhenItIsMadeLarger) {
  constexpr int scale = 4;
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const PaintedPair made = painted(name);
    const Image<Rgb8> large = draw(placed(made.painting, {.scale = scale}), right_eye).picture;
    ASSERT_EQ(large.width(), scale * test_scene::width);
    const double same = mean_difference(made.pictures.right, large, scale);
    const double other_eye = mean_difference(made.pictures.left, large, scale);
    RecordProperty(std::string(name), std::to_string(same));
    EXPECT_LT(same, 6) << name;
    EXPECT_LT(same, 0.5 * other_eye) << name;
  }
}

/// Mean distance of a picture's pixels from those of a larger one that begins `left`, `top` before it.
double difference_from_part(const Image<Rgb8>& part, const Image<Rgb8>& whole, int left, int top) {
  double sum = 0;
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) sum += std::abs(part(x, y).g - whole(x + left, y + top).g);
  return sum / static_cast<double>(part.pixels().size());
}

TEST(Painting, PlacedInASmallerPictureIsAPartOfIt) {
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const Painting whole = painted(name).painting;
    constexpr int left = 40, top = 25;
    const Painting part = placed(whole, {.width = 90, .height = 70, .left = left, .top = top});
    for (const float position : {-1.25f, -0.5f, 0.f, 0.5f, 1.25f}) {
      const ViewPosition view(position);
      const Image<Rgb8> drawn = draw(part, view).picture, from = draw(whole, view).picture;
      ASSERT_EQ(drawn.width(), 90);
      ASSERT_EQ(drawn.height(), 70);
      // Colours between lines spread from what is outside of the part, too.
      const bool curves = name == "diffusion";
      EXPECT_LT(difference_from_part(drawn, from, left, top), curves ? 3 : 0.5) << name << " " << position;
      EXPECT_GT(difference_from_part(drawn, from, left + 3, top), curves ? 6 : 3) << name << " " << position;
    }
  }
}

TEST(Painting, PlacedWithZeroParallaxShowsThatDisparityAtOnePlaceInAllViews) {
  constexpr float zero = test_scene::square_disparity;
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const Painting as_it_was = painted(name).painting, moved = placed(as_it_was, {.zero_parallax_px = zero});
    const std::vector<float> disparities = disparities_of_marks(moved);
    EXPECT_FLOAT_EQ(*std::ranges::max_element(disparities), 0) << name;
    EXPECT_FLOAT_EQ(*std::ranges::min_element(disparities), test_scene::wall_disparity - zero) << name;
    for (const float position : {-1.f, -0.5f, 0.f, 0.5f, 1.f}) {
      const ViewPosition view(position);
      // A view is the same picture, shifted by what the display's plane was shifted.
      const int shift = static_cast<int>(-position * zero);
      const Image<Rgb8> drawn = draw(moved, view).picture, before = draw(as_it_was, view).picture;
      double sum = 0, unshifted = 0;
      for (int y = 20; y < test_scene::height - 20; ++y)
        for (int x = 40; x < test_scene::width - 40; ++x) {
          sum += std::abs(drawn(x, y).g - before(x + shift, y).g);
          unshifted += std::abs(drawn(x, y).g - before(x, y).g);
        }
      constexpr double pixels = (test_scene::width - 80.) * (test_scene::height - 40.);
      EXPECT_LT(sum / pixels, name == "diffusion" ? 2 : 0.5) << name << " " << position;
      if (shift != 0) {
        EXPECT_GT(unshifted / pixels, 5) << name << " " << position;
      }
    }
  }
}

TEST(Painting, PlacedMovesAllThatIsMeasuredInPixels) {
  Painting painting = painted("expressionist").painting;
  const Painting twice = placed(painting, {.scale = 2});
  EXPECT_EQ(width_of(twice), 2 * test_scene::width);
  EXPECT_EQ(height_of(twice), 2 * test_scene::height);
  EXPECT_EQ(twice.surfaces.tolerance_px, 2 * painting.surfaces.tolerance_px);
  EXPECT_EQ(twice.relief.depth_px, 2 * painting.relief.depth_px);
  EXPECT_EQ(twice.relief.bristle_px, 2 * painting.relief.bristle_px);
  for (std::size_t i = 0; i < painting.surfaces.seen.size(); ++i) {
    const Surface &from = painting.surfaces.seen[i], &to = twice.surfaces.seen[i];
    EXPECT_EQ(to.left_px, 2 * from.left_px);
    EXPECT_EQ(to.disparity.width(), 2 * from.disparity.width());
    for (int y = 0; y < from.disparity.height(); y += 7)
      for (int x = 0; x < from.disparity.width(); x += 7) {
        const float before = from.disparity(x, y), after = to.disparity(2 * x + 1, 2 * y + 1);
        EXPECT_TRUE(after == 2 * before || (std::isnan(before) && std::isnan(after)));
      }
  }
}

TEST(Painting, TellsTheDisparitiesOfItsMarks) {
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const std::vector<float> disparities = disparities_of_marks(painted(name).painting);
    EXPECT_FLOAT_EQ(*std::ranges::max_element(disparities), test_scene::square_disparity) << name;
    EXPECT_FLOAT_EQ(*std::ranges::min_element(disparities), test_scene::wall_disparity) << name;
  }
}

}  // namespace wheatstone::painting_test
