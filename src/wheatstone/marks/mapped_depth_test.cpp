#include "wheatstone/marks/mapped_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::mapped_depth_test {

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
  Image<float> seen(width, height, 4);
  for (int y = 12; y < 28; ++y)
    for (int x = 32; x < 48; ++x) seen(x, y) = 24;
  painting.surfaces.seen.push_back({left_eye, KnownRuns(seen)});
  const Painting mapped = with_depth(painting, {{{4, 1}, {24, 9}}});
  for (const ViewPosition view : {left_eye, central_view, right_eye}) {
    const int x = static_cast<int>(std::lround(40 - (view - left_eye) * 9));
    EXPECT_EQ(draw(mapped, view).picture(x, 20), red);
    EXPECT_EQ(draw(mapped, view).picture(x + 14, 20), blue);
  }
}

constexpr DepthAround more_here{
    .x = 60, .y = 70, .disparity_px = 8, .gain_there = 1.5f, .gain_elsewhere = 0.5f, .radius_px = 25};

TEST(DepthAround, IsMoreThereAndLessElsewhereAndFallsOffSmoothly) {
  EXPECT_EQ(gain_at(more_here, 60, 70), 1.5f);
  EXPECT_NEAR(gain_at(more_here, 60 + 4 * 25, 70), 0.5f, 0.001);
  for (int x = 60; x < 200; ++x) {
    const float step =
        gain_at(more_here, static_cast<float>(x), 70) - gain_at(more_here, static_cast<float>(x + 1), 70);
    EXPECT_GE(step, 0);
    EXPECT_LE(step, 0.61f / 25);
  }
}

/// How far apart a view shows a near dot and a far one, which the reference view has in one place.
TEST(DepthAround, ChangesTheRangeOfDisparitiesByItsGainAndLeavesTheMiddleWhereItIs) {
  constexpr int width = 400, height = 60;
  constexpr float near_px = 20, far_px = 4;
  const DepthAround around{
      .x = 60, .y = 30, .disparity_px = 12, .gain_there = 1.5f, .gain_elsewhere = 0.5f, .radius_px = 60};
  Layer layer{2, {{60, 30, near_px}, {60, 30, far_px}, {60, 30, 12}, {390, 30, near_px}, {390, 30, far_px}}, {}};
  for (std::uint32_t point = 0; point < 5; ++point)
    layer.strokes.push_back({.first_point = point, .point_count = 1, .radius_px = 2});
  Painting painting{.marks = StrokePainting{.width = width, .height = height, .layers = {layer}}};
  Image<float> seen(width, height, far_px);
  seen(60, 30) = near_px;
  painting.surfaces.seen.push_back({left_eye, KnownRuns(seen)});
  const Painting mapped = with_depth_around(painting, around);
  const std::vector<ControlPoint>& points = std::get<StrokePainting>(mapped.marks).layers.front().points;
  EXPECT_NEAR(points[0].disparity - points[1].disparity, 1.5f * (near_px - far_px), 1e-3);
  EXPECT_EQ(points[2].disparity, 12);
  EXPECT_NEAR(points[3].disparity - points[4].disparity, 0.5f * (near_px - far_px), 1e-2);
  const KnownRuns& surface = mapped.surfaces.seen.front().disparity;
  EXPECT_NEAR(surface(60, 30), 12 + 1.5f * (near_px - 12), 0.1);
  EXPECT_NEAR(surface(398, 30), 12 + 0.5f * (far_px - 12), 0.1);
}

TEST(DepthAround, OfOneGainIsThatGainEverywhere) {
  for (const Marks marks : {Marks::strokes, Marks::curves}) {
    const Painting& painting = painting_of_still(marks);
    const Painting twice = with_depth_around(painting, {.disparity_px = 8, .gain_there = 2, .gain_elsewhere = 2});
    const Painting same = with_depth(painting, {{{-100, 8 + 2 * (-100 - 8)}, {100, 8 + 2 * (100 - 8)}}});
    EXPECT_LE(mean_difference(draw(twice, right_eye).picture, draw(same, right_eye).picture), 0.1) << name_of(marks);
  }
}

TEST(DepthAround, LeavesTheReferenceViewAsItIs) {
  for (const Marks marks : {Marks::strokes, Marks::curves}) {
    const Painting& painting = painting_of_still(marks);
    const Painting mapped = with_depth_around(painting, more_here);
    EXPECT_LE(mean_difference(draw(mapped, left_eye).picture, draw(painting, left_eye).picture), 1.5) << name_of(marks);
    EXPECT_GT(mean_difference(draw(mapped, right_eye).picture, draw(painting, right_eye).picture), 1.5);
  }
}

/// Neighbours that are equally near, in scenes flat or deep, around narrow places with strong gains.
TEST(DepthAround, NeitherFoldsNorTearsWhatIsEquallyNear) {
  constexpr int width = 300, height = 40;
  for (const float nearness_px : {0.f, 10.f, 40.f})
    for (const auto& [there, elsewhere] : {std::pair{2.f, 0.f}, {0.f, 2.f}, {1.5f, 0.5f}}) {
      Painting painting{.marks = StrokePainting{.width = width, .height = height}};
      Image<float> seen(width, height, nearness_px);
      for (int y = height / 2; y < height; ++y) std::ranges::fill(seen.row(y), 20.f);
      painting.surfaces.seen.push_back({left_eye, KnownRuns(seen)});
      const Painting mapped = with_depth_around(
          painting,
          {.x = 150, .y = 20, .disparity_px = 20, .gain_there = there, .gain_elsewhere = elsewhere, .radius_px = 5});
      for (const Surface& surface : mapped.surfaces.seen)
        for (int y = 0; y < height; ++y)
          for (int x = 0; x + 1 < width; ++x) {
            constexpr float step_px = 1 / disparity_steps;
            EXPECT_LE(std::abs(surface.disparity(x + 1, y) - surface.disparity(x, y)), 0.5f + step_px) << x << ' ' << y;
          }
    }
}

}  // namespace wheatstone::mapped_depth_test
