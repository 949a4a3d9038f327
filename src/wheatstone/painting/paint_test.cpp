#include "wheatstone/painting/paint.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/strokes/stroke_measures.h"

namespace wheatstone {
namespace {

Style small_style(Propagation propagation = Propagation::strokes) {
  Style style;
  style.radii_px = {8, 4, 2};
  style.absolute_radii = true;
  style.propagation = propagation;
  return style;
}

PaintedPair paint_scene(const Style& style) { return paint(test_scene::photographs(), test_scene::geometry(), style); }

double difference_of(const PaintedPair& painted) {
  return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
}

TEST(Paint, StrokesFuseWhereIndependentEyesDoNot) {
  const double strokes = difference_of(paint_scene(small_style(Propagation::strokes)));
  const double raster = difference_of(paint_scene(small_style(Propagation::raster)));
  const double independent = difference_of(paint_scene(small_style(Propagation::independent)));
  EXPECT_LT(strokes, 0.35 * independent);
  EXPECT_LT(raster, 0.35 * independent);
}

TEST(Paint, CoversBothEyes) {
  const PaintedPair painted = paint_scene(small_style());
  EXPECT_LT(painted.left_bare_share, 0.005);
  EXPECT_LT(painted.right_bare_share, 0.005);
}

TEST(Paint, PicturesAreWhatDrawMakesOfTheMarks) {
  const StereoPair photographs = test_scene::photographs();
  const PaintedPair painted = paint(photographs, test_scene::geometry(), small_style());
  EXPECT_EQ(draw(painted.painting, left_eye, {.background = photographs.left}).picture, painted.pictures.left);
  EXPECT_EQ(draw(painted.painting, right_eye, {.background = photographs.right}).picture, painted.pictures.right);
}

TEST(Paint, GivesTheSameBytesOnAnyNumberOfThreads) {
  StrokePainting first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const PaintedPair painted = paint_scene(small_style());
    if (first.layers.empty()) first = painted.painting;
    EXPECT_EQ(painted.painting, first);
  }
}

TEST(Paint, DrawsFarStrokesBeforeNearOnesInEveryLayer) {
  for (const PaintedPair painted = paint_scene(small_style()); const Layer& layer : painted.painting.layers) {
    float last = -INFINITY;
    for (const Stroke& stroke : layer.strokes) {
      EXPECT_GE(std::round(stroke.disparity), std::round(last));
      last = stroke.disparity;
    }
  }
}

TEST(Paint, PairsEveryStrokeThatBothEyesCanSee) {
  const StereoGeometry geometry = test_scene::geometry();
  const StrokeMeasures strokes = measure_strokes(paint_scene(small_style()).painting, geometry);
  EXPECT_DOUBLE_EQ(strokes.paired_share, 1);
  EXPECT_LT(strokes.shape_differs_share, 0.01);
  const StrokeMeasures independent =
      measure_strokes(paint_scene(small_style(Propagation::independent)).painting, geometry);
  EXPECT_DOUBLE_EQ(independent.paired_share, 0);
}

TEST(Paint, FinestStrokesDoNotSpillOverDepthEdgesUnlessTheTestIsOff) {
  const StereoGeometry geometry = test_scene::geometry();
  Style style = small_style();
  EXPECT_DOUBLE_EQ(spilling_share(paint_scene(style).painting.layers.back(), geometry, 2), 0);
  style.depth_test = false;
  EXPECT_GT(spilling_share(paint_scene(style).painting.layers.back(), geometry, 2), 0.005);
}

TEST(Paint, RightOnlyStrokesBeginOnTheGrownOcclusion) {
  const StereoGeometry geometry = test_scene::geometry();
  Style style = small_style();
  style.occlusion_dilation = 0;
  for (const PaintedPair painted = paint_scene(style); const Layer& layer : painted.painting.layers) {
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.views != ViewRange{right_eye, right_eye}) continue;
      EXPECT_EQ(stroke.reference_view, right_eye);
      const ControlPoint& begin = layer.points[stroke.first_point];
      EXPECT_NE(geometry.right_occlusion(static_cast<int>(begin.x), static_cast<int>(begin.y)), 0);
    }
  }
}

TEST(Paint, WorksWithDisparitiesOfBothSigns) {
  const StereoPair photographs = test_scene::photographs();
  constexpr float convergence = 10;
  StereoGeometry geometry = test_scene::geometry();
  StereoPair converged = photographs;
  // The right camera is turned: everything moves by ten pixels there.
  for (int y = 0; y < test_scene::height; ++y)
    for (int x = 0; x < test_scene::width; ++x)
      converged.right(x, y) = photographs.right(std::max(x - static_cast<int>(convergence), 0), y);
  for (float& d : geometry.left_disparity.pixels()) d -= convergence;
  const StereoGeometry turned = geometry_from_left(geometry.left_disparity);
  const PaintedPair painted = paint(converged, turned, small_style());
  EXPECT_LT(measure_left_right_difference(painted.pictures, turned.left_disparity).mean_absolute, 3);
}

TEST(Paint, RefusesWhatDoesNotFitTogether) {
  const StereoPair photographs = test_scene::photographs();
  StereoGeometry geometry = test_scene::geometry();
  geometry.left_disparity(3, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(paint(photographs, geometry, small_style()), Error);
  geometry.left_disparity = Image<float>(3, 3);
  EXPECT_THROW(paint(photographs, geometry, small_style()), Error);
  Style style = small_style();
  style.threshold = 0;
  EXPECT_THROW(paint(photographs, test_scene::geometry(), style), Error);
}

TEST(Paint, EndsWhenItsProgressThrows) {
  const auto stop = [](std::string_view, double) { throw Error(ErrorKind::interrupted, "stopped"); };
  EXPECT_THROW(paint(test_scene::photographs(), test_scene::geometry(), small_style(), stop), Error);
}

}  // namespace
}  // namespace wheatstone
