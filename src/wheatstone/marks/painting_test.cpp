// Paintings of any kind of marks: drawn as their kind is, and made larger.

#include "wheatstone/marks/painting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone {
namespace {

Style style_of(std::string_view name) {
  Style style = style_by_name(name);
  style.absolute_radii = true;
  style.background = Background::colour;
  style.texture = style.marks == Marks::strokes;
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
    const Image<Rgb8> large = draw(resized(made.painting, scale), right_eye).picture;
    ASSERT_EQ(large.width(), scale * test_scene::width);
    const double same = mean_difference(made.pictures.right, large, scale);
    const double other_eye = mean_difference(made.pictures.left, large, scale);
    RecordProperty(std::string(name), std::to_string(same));
    EXPECT_LT(same, 6) << name;
    EXPECT_LT(same, 0.5 * other_eye) << name;
  }
}

TEST(Painting, TellsTheDisparitiesOfItsMarks) {
  for (const std::string_view name : {"expressionist", "posterise", "diffusion"}) {
    const std::vector<float> disparities = disparities_of_marks(painted(name).painting);
    EXPECT_FLOAT_EQ(*std::ranges::max_element(disparities), test_scene::square_disparity) << name;
    EXPECT_FLOAT_EQ(*std::ranges::min_element(disparities), test_scene::wall_disparity) << name;
  }
}

}  // namespace
}  // namespace wheatstone
