#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/flatten_internal.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/random.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/begun_canvas_internal.h"
#include "wheatstone/strokes/depth_edges_internal.h"
#include "wheatstone/strokes/handed_back_internal.h"
#include "wheatstone/strokes/jitter_internal.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_plan.h"
#include "wheatstone/strokes/reference_picture.h"
#include "wheatstone/strokes/repair.h"
#include "wheatstone/strokes/seed_internal.h"
#include "wheatstone/strokes/trace_stroke_internal.h"
#include "wheatstone/strokes/view_to_plan_internal.h"

namespace wheatstone::plan_test {

/// A view that is planned on a bare canvas of its own.
struct Bench {
  explicit Bench(Image<Rgb8> picture, Style wanted = {})
      : style(std::move(wanted)),
        photograph(std::move(picture)),
        reference(make_reference(photograph, 4, style)),
        canvas(photograph.width(), photograph.height(), {0, 0, 0}),
        disparity(photograph.width(), photograph.height(), 5.f),
        view{photograph, disparity, {}, left_eye} {}
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  LayerPlan plan() const {
    return {.style = style,
            .view = view,
            .canvas = canvas,
            .reference = std::make_shared<const ReferencePicture>(reference)};
  }

  void cover(float level) {
    for (Image<float>* plane : {&canvas.red, &canvas.green, &canvas.blue}) std::ranges::fill(plane->pixels(), level);
    std::ranges::fill(canvas.coverage.pixels(), 1.f);
  }

  Style style;
  Image<Rgb8> photograph;
  ReferencePicture reference;
  Canvas canvas;
  Image<float> disparity;
  View view;
};

Image<Rgb8> horizontal_stripes(int width, int height) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y) {
    const auto level = static_cast<std::uint8_t>(128 + 100 * std::sin(0.2 * y));
    std::ranges::fill(picture.row(y), Rgb8{level, level, level});
  }
  return picture;
}

TEST(DepthEdges, AreExactlyThePixelsWhoseWindowHoldsAJump) {
  const Image<float> disparity = test_scene::geometry().left_disparity;
  for (const float radius : {1.f, 2.5f, 9.f}) {
    const Image<std::uint8_t> marked = near_depth_edge(disparity_in_steps(disparity), radius, 2);
    const int reach = static_cast<int>(std::ceil(radius));
    for (int y = 0; y < disparity.height(); ++y) {
      for (int x = 0; x < disparity.width(); ++x) {
        bool jump = false;
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, disparity.height() - 1); ++v)
          for (int u = std::max(x - reach, 0); u <= std::min(x + reach, disparity.width() - 1); ++u)
            jump = jump || std::abs(disparity(u, v) - disparity(x, y)) > 2;
        ASSERT_EQ(marked(x, y) != 0, jump) << x << "," << y << " radius " << radius;
      }
    }
  }
}

TEST(DepthEdges, DistanceIsHalfAPixelBesideAnEdge) {
  Image<float> disparity(20, 3, 1);
  for (int y = 0; y < 3; ++y)
    for (int x = 10; x < 20; ++x) disparity(x, y) = 9;
  const KnownRuns distance = distance_to_depth_edge(disparity_in_steps(disparity), 2, 6);
  EXPECT_FLOAT_EQ(distance(9, 1), 0.5f);
  EXPECT_FLOAT_EQ(distance(10, 1), 0.5f);
  EXPECT_NEAR(distance(14, 1), 4.5f, 0.3f);
}

TEST(DepthEdges, DistancesAreThoseToTheNearestOneUpToTheBorders) {
  constexpr float most_px = 7, chamfer_error = 0.07f;
  for (const int width : {5, 64, 131}) {
    Image<float> disparity(width, 83, 1);
    for (const auto& [x, y] : {std::pair{3, 2}, {width - 1, 40}, {width / 2, 79}}) disparity(x, y) = 9;
    const Image<std::int16_t> steps = disparity_in_steps(disparity);
    const Image<std::uint8_t> edges = near_depth_edge(steps, 1, 2);
    const KnownRuns distance = distance_to_depth_edge(steps, 2, most_px);
    for (int y = 0; y < disparity.height(); ++y) {
      for (int x = 0; x < width; ++x) {
        float nearest = most_px;
        for (int v = 0; v < disparity.height(); ++v)
          for (int u = 0; u < width; ++u)
            if (edges(u, v) != 0)
              nearest = std::min(nearest, std::hypot(static_cast<float>(u - x), static_cast<float>(v - y)) + 0.5f);
        const float measured = std::isnan(distance(x, y)) ? most_px : distance(x, y);
        ASSERT_NEAR(measured, nearest, chamfer_error * nearest) << x << ' ' << y;
      }
    }
  }
}

TEST(SettleDisparities, LeavesPointsBeyondThePicture) {
  const Bench bench(Image<Rgb8>(20, 12));
  LayerPlan plan = bench.plan();
  plan.edge_distance = distance_to_depth_edge(disparity_in_steps(bench.disparity), 2, 6);
  std::vector<ControlPoint> points{{-30, 4, 5}, {4, 12.5f, 5}, {4, 4000, 5}, {40, -7, 5}};
  settle_disparities(plan, 2, points);
  for (const ControlPoint& point : points) EXPECT_EQ(point.disparity, 5) << point.x << ' ' << point.y;
}

TEST(DepthEdges, OnlyTheFarSideLiesBehindOne) {
  Image<float> disparity(20, 3, 1);
  for (int y = 0; y < 3; ++y)
    for (int x = 10; x < 20; ++x) disparity(x, y) = 9;
  const Image<std::uint8_t> behind = behind_depth_edge(disparity_in_steps(disparity), 2, 2);
  EXPECT_EQ(behind(9, 1), 255);
  EXPECT_EQ(behind(7, 1), 0);
  EXPECT_EQ(behind(10, 1), 0);
}

TEST(Reference, KernelWidthIsTwiceTheBlurTimesTheRadiusPlusOne) {
  EXPECT_EQ(blur_kernel_px(0.5f, 8), 9);
  EXPECT_EQ(blur_kernel_px(0.5f, 2), 3);
  EXPECT_EQ(blur_kernel_px(0, 8), 1);
}

TEST(Reference, ReducedMedianStaysNearTheFullOne) {
  const StereoPair pair = test_scene::photographs();
  Style style;
  for (const float radius : {8.f, 24.f}) {
    const ReferencePicture reduced = make_reference(pair.left, radius, style);
    // The full median, by sorting.
    const int reach = blur_kernel_px(style.blur, radius) / 2;
    double difference = 0;
    int count = 0;
    for (int y = reach; y < pair.left.height() - reach; y += 3) {
      for (int x = reach; x < pair.left.width() - reach; x += 3) {
        std::vector<std::uint8_t> window;
        for (int v = y - reach; v <= y + reach; ++v)
          for (int u = x - reach; u <= x + reach; ++u) window.push_back(pair.left(u, v).g);
        std::ranges::nth_element(window, window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2));
        difference += std::abs(window[window.size() / 2] - reduced.green(x, y));
        ++count;
      }
    }
    EXPECT_LT(difference / count, 6) << radius;
  }
}

TEST(Plan, EveryCellOfABareCanvasGetsAStroke) {
  const Bench bench(horizontal_stripes(80, 60));
  const Layer layer = plan_layer(bench.plan());
  EXPECT_EQ(layer.strokes.size(), 20u * 15u);
}

TEST(Plan, NothingIsPaintedWhereThePictureIsRightAlready) {
  Bench bench(Image<Rgb8>(80, 60, {100, 100, 100}));
  bench.cover(100);
  EXPECT_TRUE(plan_layer(bench.plan()).strokes.empty());
  bench.cover(100 + 60);  // 60·√3 = 104 > T = 100
  EXPECT_FALSE(plan_layer(bench.plan()).strokes.empty());
  bench.cover(100 + 55);  // 95 < T
  EXPECT_TRUE(plan_layer(bench.plan()).strokes.empty());
}

TEST(Plan, AStrokeBeginsAtTheLargestErrorOfItsCell) {
  Image<Rgb8> picture(40, 40, {100, 100, 100});
  picture(13, 22) = {255, 255, 255};
  Style style;
  style.blur = 0;
  style.max_length = style.min_length = 0;
  Bench bench(picture, style);
  bench.cover(100);
  const Layer layer = plan_layer(bench.plan());
  ASSERT_EQ(layer.strokes.size(), 1u);
  EXPECT_EQ(layer.points[0], (ControlPoint{13.5f, 22.5f, 5}));
  EXPECT_EQ(layer.strokes[0].colour, (Rgb8{255, 255, 255}));
}

/// Grey, and from column 50 on so red that it is unlike grey, though less than T.
Image<Rgb8> grey_then_red() {
  Image<Rgb8> picture(80, 60, {100, 100, 100});
  for (int y = 0; y < 60; ++y) std::fill_n(&picture(50, y), 30, Rgb8{180, 100, 100});
  return picture;
}

TEST(Plan, AStrokeEndsBeforeItCoversPaintOfAColourUnlikeItsOwn) {
  Style style;
  style.min_length = style.max_length = 16;
  style.orientation = Orientation::gradient;
  Bench bench(grey_then_red(), style);
  bench.cover(0);
  // A slope of brightness, too slight to see, sends strokes along the rows.
  for (int y = 0; y < 60; ++y)
    for (std::uint8_t& level : bench.reference.luminance.row(y)) level = static_cast<std::uint8_t>(4 * y);
  for (const bool backwards : {false, true}) {
    std::vector<ControlPoint> points;
    trace_stroke(bench.plan(), {bench.canvas}, {{.x = 30, .y = 30}, 4, backwards}, points);
    EXPECT_GT(points.size(), 4u);
    for (const ControlPoint& point : points) EXPECT_LT(point.x, 50);
  }
}

TEST(Plan, MisplacedPaintIsPaintedOverWhateverTheThreshold) {
  Bench bench(grey_then_red());
  bench.cover(100);
  EXPECT_TRUE(plan_layer(bench.plan()).strokes.empty());
  ViewOnCanvas at(bench.view, bench.style, 640, bench.canvas);
  const Image<std::uint8_t> misplaced = misplaced_paint(at, bench.style);
  EXPECT_EQ(misplaced(30, 30), 0);
  EXPECT_EQ(misplaced(60, 30), 255);
  LayerPlan plan = bench.plan();
  plan.misplaced = misplaced;
  const Layer layer = plan_layer(plan);
  EXPECT_FALSE(layer.strokes.empty());
  for (const Stroke& stroke : layer.strokes) EXPECT_GT(stroke.colour.r, 160);

  Style jittered;
  jittered.jitter.hue = 0.5f;
  EXPECT_TRUE(misplaced_paint(at, jittered).empty()) << "its colours are meant to be others";
}

/// The marks that cover places of a bench's bare canvas.
Layer repaired(const Bench& bench, ImageView<const std::uint8_t> places) {
  const ViewOnCanvas at(bench.view, bench.style, 640);
  const LayerPlan plan = make_layer_plan(at, bench.style, 2);
  const Image<std::uint8_t> bare = bare_pixels(at.canvas, places);
  return repair({.target = {.picture = bench.photograph,
                            .places = bare,
                            .disparity = bench.disparity,
                            .view = left_eye,
                            .reference_view = left_eye},
                 .scaled = at.scaled,
                 .mixed_colours = plan.mixed_colours},
                bench.style);
}

TEST(RepairOfStrokes, ADotBehindADepthEdgeHasItsSurfacesColour) {
  Bench bench(grey_then_red());
  for (int y = 0; y < 60; ++y) std::fill_n(&bench.disparity(51, y), 29, 20.f);  // column 50 is red and far
  Image<std::uint8_t> wanted(80, 60);
  wanted(50, 30) = 255;
  const Layer dots = repaired(bench, wanted);
  ASSERT_EQ(dots.strokes.size(), 1u);
  EXPECT_EQ(dots.strokes[0].colour, (Rgb8{100, 100, 100}));
}

TEST(RepairOfStrokes, BarePixelsOfOneColourAreCoveredByOneThread) {
  Bench bench(grey_then_red());
  Image<std::uint8_t> wanted(80, 60);
  for (int y = 10; y < 16; ++y) wanted(20, y) = 255;
  wanted(60, 30) = 255;
  const Layer cover = repaired(bench, wanted);
  ASSERT_EQ(cover.strokes.size(), 2u);
  EXPECT_EQ(cover.strokes[1].point_count, 1u);
  EXPECT_NE(cover.strokes[0].colour, cover.strokes[1].colour);
  const auto thread = cover.points_of(cover.strokes[0]);
  EXPECT_EQ(thread.front().y, 10.5f);
  EXPECT_GE(thread.back().y + cover.strokes[0].radius_px, 15.5f);

  bench.style.max_length = bench.style.min_length = 0;
  const Layer dots = repaired(bench, wanted);
  EXPECT_GT(dots.strokes.size(), 2u);
  EXPECT_TRUE(std::ranges::all_of(dots.strokes, [](const Stroke& dot) { return dot.point_count == 1; }));
}

TEST(Plan, StrokesRunAcrossTheGradientWithPointsOneRadiusApart) {
  const Bench bench(horizontal_stripes(200, 80));
  std::vector<ControlPoint> points;
  trace_stroke(bench.plan(), {bench.canvas}, {{.x = 100, .y = 40}, 4, false}, points);
  ASSERT_GT(points.size(), 4u);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_NEAR(std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y), 4, 1e-3);
    EXPECT_NEAR(points[i].y, points[0].y, 1);
  }
}

TEST(Plan, StrokesHaveNoMorePointsThanTheirLongest) {
  const Bench bench(horizontal_stripes(400, 60));
  for (const Layer layer = plan_layer(bench.plan()); const Stroke& stroke : layer.strokes)
    EXPECT_LE(stroke.point_count, 16u);
}

TEST(Plan, StrokesEndWhereTheCanvasIsNearerThanTheirColour) {
  // Left half dark, right half light; the canvas has the light tone already.
  Image<Rgb8> picture(200, 40, {20, 20, 20});
  for (int y = 0; y < 40; ++y)
    for (int x = 100; x < 200; ++x) picture(x, y) = {220, 220, 220};
  Style style;
  style.min_length = 1;
  Bench bench(picture, style);
  bench.cover(220);
  std::vector<ControlPoint> points;
  // A steady direction to the right is forced by a strong memory of it.
  bench.style.curvature = 0.01f;
  for (const bool backwards : {false, true})
    trace_stroke(bench.plan(), {bench.canvas}, {{.x = 90, .y = 20}, 4, backwards}, points);
  for (const ControlPoint& point : points) EXPECT_LT(point.x, 100 + 2 * 4);
}

TEST(Plan, GradientOrientationEndsStrokesWhereItVanishes) {
  const Image<Rgb8> flat(80, 60, {90, 120, 60});
  Style style;
  style.orientation = Orientation::gradient;
  const Bench paper(flat, style), ours(flat, {});
  const Layer dots = plan_layer(paper.plan());
  const Layer strokes = plan_layer(ours.plan());
  EXPECT_TRUE(std::ranges::all_of(dots.strokes, [](const Stroke& s) { return s.point_count == 1; }));
  EXPECT_TRUE(std::ranges::any_of(strokes.strokes, [](const Stroke& s) { return s.point_count > 4; }));
}

TEST(Plan, StrokesBeginOnlyOnTheirSeeds) {
  const Bench bench(horizontal_stripes(80, 60));
  Image<std::uint8_t> seeds(80, 60);
  for (int y = 20; y < 40; ++y)
    for (int x = 30; x < 50; ++x) seeds(x, y) = 255;
  LayerPlan plan = bench.plan();
  plan.seeds = seeds;
  const Layer layer = plan_layer(plan);
  ASSERT_FALSE(layer.strokes.empty());
  for (const Stroke& stroke : layer.strokes) {
    const ControlPoint& begin = layer.points[stroke.first_point];
    EXPECT_NE(seeds(static_cast<int>(begin.x), static_cast<int>(begin.y)), 0);
  }
}

TEST(Plan, IsTheSameForTheSameSeedOnly) {
  Bench bench(horizontal_stripes(80, 60));
  const Layer layer = plan_layer(bench.plan());
  EXPECT_EQ(plan_layer(bench.plan()), layer);
  bench.style.seed = 2;
  EXPECT_NE(plan_layer(bench.plan()), layer);
}

TEST(HandingBack, UndoesTakingIn) {
  Layer layer{8, {{100.25f, 30.5f, 12}, {-3, 4, 0}}, {{.point_count = 2, .radius_px = 6, .disparity = 12}}};
  const Layer before = layer;
  const ViewFrame frame{-40, 4};
  take_in(frame, layer);
  EXPECT_EQ(layer.points[0], (ControlPoint{35.0625f, 7.625f, 3}));
  EXPECT_EQ(layer.strokes[0].radius_px, 1.5f);
  hand_back(frame, layer);
  EXPECT_EQ(layer, before);
}

TEST(DotsLeftOut, AreTheNearPixelsThatASmallerOneDoesNotShow) {
  constexpr Rgb8 near_colour{200, 0, 0}, far_colour{0, 0, 100};
  Image<Rgb8> colour(6, 2, far_colour);
  Image<float> disparity(6, 2, 4.f);
  for (int y = 0; y < 2; ++y) {
    for (const int x : {2, 4}) {
      colour(x, y) = near_colour;
      disparity(x, y) = 12;
    }
  }
  Image<std::uint8_t> wanted(6, 2);
  wanted(4, 1) = wanted(2, 0) = wanted(2, 1) = wanted(3, 0) = 255;
  const View view{colour, disparity, wanted, right_eye};
  Layer dots = dots_left_out(view, smaller_view(view, 2));
  hand_back({0, 2}, dots);
  ASSERT_EQ(dots.strokes.size(), 1u) << "the near column that is wanted beside the far one";
  EXPECT_EQ(dots.points[0], (ControlPoint{2.5f, 1, 12}));
  EXPECT_EQ(dots.strokes[0].colour, near_colour);
  EXPECT_EQ(dots.strokes[0].radius_px, 1);
}

TEST(DotsLeftOut, AreWhatMakesNoWholePixel) {
  const Image<Rgb8> colour(5, 3, Rgb8{1, 2, 3});
  const Image<float> disparity(5, 3, -4.f);
  Image<std::uint8_t> wanted(5, 3, 255);
  wanted(4, 0) = 0;
  const View view{colour, disparity, wanted, right_eye};
  Layer dots = dots_left_out(view, smaller_view(view, 2));
  hand_back({0, 2}, dots);
  const std::vector<ControlPoint> expected{{4.5f, 1.5f, -4}, {1, 2.5f, -4}, {3, 2.5f, -4}, {4.5f, 2.5f, -4}};
  EXPECT_EQ(dots.points, expected);
  for (const Stroke& dot : dots.strokes) EXPECT_EQ(dot.colour, (Rgb8{1, 2, 3}));
}

TEST(LayerOrder, GoesFromFarToNear) {
  Layer layer;
  for (int i = 0; i < 500; ++i) {
    layer.points.push_back({});
    layer.strokes.push_back({.first_point = static_cast<std::uint32_t>(i),
                             .point_count = 1,
                             .disparity = static_cast<float>((i * 37) % 11) - 5});
  }
  Layer other = layer;
  sort_far_to_near(layer, 7);
  for (std::size_t i = 1; i < layer.strokes.size(); ++i)
    EXPECT_LE(layer.strokes[i - 1].disparity, layer.strokes[i].disparity);
  sort_far_to_near(other, 8);
  EXPECT_NE(layer.strokes, other.strokes) << "equal depths are permuted by the seed";
}

TEST(Plan, TakesSingleWrongDisparitiesOutOfAStroke) {
  Bench bench(horizontal_stripes(80, 60));
  bench.style.depth_test = false;  // strokes go on over wrong disparities
  constexpr float wrong = 40;
  for (int y = 0; y < 60; ++y)
    for (int x = y % 2; x < 80; x += 11) bench.disparity(x, y) = wrong;
  const Layer layer = plan_layer(bench.plan());
  int taken_out = 0;
  for (const Stroke& stroke : layer.strokes) {
    const auto points = layer.points_of(stroke);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const bool alone = points[i - 1].disparity != wrong && points[i + 1].disparity != wrong;
      if (!alone || bench.disparity(static_cast<int>(points[i].x), static_cast<int>(points[i].y)) != wrong) continue;
      EXPECT_EQ(points[i].disparity, 5);
      ++taken_out;
    }
  }
  EXPECT_GT(taken_out, 20);
}

TEST(Jitter, StaysWithinHalfOfItsAmountAndIsSpreadOverIt) {
  ColourJitter jitter;
  jitter.red = 0.3f;
  std::set<int> reds;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Rgb8 colour = jittered({128, 60, 200}, jitter, hash_keys({i}));
    EXPECT_NEAR(colour.r, 128, 0.15f * 255 + 1);
    EXPECT_NEAR(colour.g, 60, 1);
    reds.insert(colour.r);
  }
  EXPECT_GT(reds.size(), 60u);
}

TEST(Jitter, OfHueAndSaturationKeepsTheLightnessAndColoursGreys) {
  const auto seen = [](Rgb8 c) {
    return oklab_from_linear({linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)});
  };
  const ColourJitter jitter{.hue = 0.5f, .saturation = 0.8f};
  for (const Rgb8 colour : {Rgb8{200, 200, 200}, Rgb8{250, 250, 252}, Rgb8{20, 30, 90}, Rgb8{230, 30, 40}}) {
    float most_changed = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Oklab before = seen(colour), after = seen(jittered(colour, jitter, hash_keys({i})));
      constexpr float of_rounding = 0.012f;
      ASSERT_NEAR(after.lightness, before.lightness, of_rounding);
      most_changed = std::max(most_changed, std::hypot(after.a - before.a, after.b - before.b));
    }
    EXPECT_GT(most_changed, 0.01f);
  }
}

TEST(Jitter, LeavesColoursAloneWithoutAny) { EXPECT_EQ(jittered({1, 2, 3}, {}, 99), (Rgb8{1, 2, 3})); }

TEST(Flatten, CurvesBeginAndEndOnTheirOuterControlPoints) {
  Layer layer;
  layer.points = {{10, 10, 2}, {20, 14, 2}, {25, 30, 2}, {40, 31, 2}};
  layer.strokes.push_back({.point_count = 4, .radius_px = 3});
  const FlatLayer flat = flatten(layer);
  const SeenLayer left(flat, left_eye), right(flat, right_eye);
  EXPECT_FLOAT_EQ(left.x(0), 10);
  EXPECT_NEAR(left.x(flat.strokes[0].vertex_count - 1), 40, 1e-3);
  EXPECT_FLOAT_EQ(right.x(0), 8);
  EXPECT_NEAR(right.x(flat.strokes[0].vertex_count - 1), 38, 1e-3);
  EXPECT_NEAR(flat.y[flat.strokes[0].vertex_count - 1], 31, 1e-3);
}

}  // namespace wheatstone::plan_test
