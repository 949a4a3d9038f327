#include "wheatstone/marks/mapped_depth.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {
namespace {

const Painting& painting_of_still(Marks marks) {
  static const SyntheticStill still = make_synthetic_still({.width = 200, .height = 140, .samples_a_side = 1});
  static const auto painted = [](Marks wanted) {
    Style style;
    style.marks = wanted;
    return plan_painting(still.pictures, still.geometry, style);
  };
  static const std::array paintings{painted(Marks::strokes), painted(Marks::regions), painted(Marks::curves)};
  return paintings[marks == Marks::strokes ? 0 : marks == Marks::regions ? 1 : 2];
}

double mean_difference(ImageView<const Rgb8> a, ImageView<const Rgb8> b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      sum += std::abs(a(x, y).r - b(x, y).r) + std::abs(a(x, y).g - b(x, y).g) + std::abs(a(x, y).b - b(x, y).b);
  return sum / 3 / a.width() / a.height();
}

constexpr std::array all_marks{Marks::strokes, Marks::regions, Marks::curves};

/// Curves that only views beside the eyes are planned for give way in the eyes.
bool draws_alike(Marks marks, float factor) { return marks != Marks::curves || factor <= 1; }

TEST(MappedDepth, OfItselfChangesNothing) {
  for (const Marks marks : all_marks) {
    const Painting& painting = painting_of_still(marks);
    EXPECT_TRUE(with_depth(painting, {}) == painting);
    const Painting mapped = with_depth(painting, {{{-100, -100}, {100, 100}}});
    for (const ViewPosition view : {left_eye, central_view, right_eye})
      EXPECT_EQ(draw(mapped, view).picture, draw(painting, view).picture) << name_of(marks);
  }
}

/// View v of the painting with s times the disparities is its view v_ref + s (v − v_ref).
TEST(MappedDepth, TimesAFactorIsTheViewOfEyesThatManyTimesAsFarApart) {
  for (const Marks marks : all_marks)
    for (const float factor : {0.5f, 1.5f}) {
      if (!draws_alike(marks, factor)) continue;
      const Painting& painting = painting_of_still(marks);
      const Painting mapped = with_depth(painting, {{{-100, -100 * factor}, {100, 100 * factor}}});
      for (const ViewPosition view : {left_eye, central_view, right_eye}) {
        const ViewPosition same(left_eye.eye_separations() + factor * (view - left_eye));
        const Image<Rgb8> expected = draw(painting, same).picture;
        EXPECT_LE(mean_difference(draw(mapped, view).picture, expected), 0.35) << name_of(marks) << ' ' << factor;
        EXPECT_GT(mean_difference(draw(painting, left_eye).picture, expected), view == left_eye ? -1 : 2)
            << "it would be right by chance";
      }
    }
}

TEST(MappedDepth, LeavesTheReferenceViewAsItIsAlsoWhereRegionsOfTheSceneGetAlmostNoDepth) {
  const DisparityMapping mapping{{{-100, -3}, {8, -2}, {14, 8}, {100, 9}}};
  for (const Marks marks : all_marks) {
    const Painting& painting = painting_of_still(marks);
    EXPECT_LE(mean_difference(draw(with_depth(painting, mapping), left_eye).picture, draw(painting, left_eye).picture),
              1.5)
        << name_of(marks);
  }
}

/// A wide far stroke, drawn after the near one, which a surface before it hides.
TEST(MappedDepth, KeepsTheOrderInWhichThingsHideEachOther) {
  constexpr int width = 80, height = 40;
  constexpr Rgb8 red{200, 0, 0}, blue{0, 0, 200};
  Layer layer{20, {{40, 20, 24}, {-40, 20, 4}, {120, 20, 4}}, {}};
  layer.strokes.push_back({.point_count = 1, .radius_px = 10, .colour = red, .disparity = 24, .views = all_views});
  layer.strokes.push_back(
      {.first_point = 1, .point_count = 2, .radius_px = 30, .colour = blue, .disparity = 4, .views = all_views});
  Painting painting{.marks = StrokePainting{.width = width, .height = height, .layers = {layer}}};
  Surface seen{left_eye, Image<float>(width, height, 4)};
  for (int y = 12; y < 28; ++y)
    for (int x = 32; x < 48; ++x) seen.disparity(x, y) = 24;
  painting.surfaces.seen.push_back(seen);
  const Painting mapped = with_depth(painting, {{{4, 1}, {24, 9}}});
  for (const ViewPosition view : {left_eye, central_view, right_eye}) {
    const int x = static_cast<int>(std::lround(40 - (view - left_eye) * 9));
    EXPECT_EQ(draw(mapped, view).picture(x, 20), red);
    EXPECT_EQ(draw(mapped, view).picture(x + 14, 20), blue);
  }
}

}  // namespace
}  // namespace wheatstone
