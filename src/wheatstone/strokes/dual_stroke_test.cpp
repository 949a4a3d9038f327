// Strokes of two colours: they must fuse as single ones do, and be worth more.

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/two_surfaces.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/strokes/reference_picture.h"
#include "wheatstone/strokes/stroke_measures.h"

namespace wheatstone::dual_stroke_test {

Style small_style(bool dual, float threshold, Propagation propagation = Propagation::strokes) {
  Style style = style_by_name(dual ? "dual" : "impressionist");
  style.radii_px = {8, 4, 2};
  style.absolute_radii = true;
  style.threshold = threshold;
  style.propagation = propagation;
  return style;
}

/// A painting's root mean squared RGB distance from its photograph in the left eye, and the strokes that were planned
/// for it.
struct Effort {
  double error = 0;
  double strokes = 0;
};

Effort effort_of(bool dual, float threshold) {
  const StereoPair photographs = test_scene::photographs();
  const PaintedView painted =
      paint_view(photographs.left, test_scene::geometry().left_disparity, left_eye, small_style(dual, threshold));
  Effort effort;
  for (const Layer& layer : painted.painting.layers) effort.strokes += static_cast<double>(count_strokes(layer));
  for (std::size_t i = 0; i < painted.picture.pixels().size(); ++i) {
    const Rgb8 a = painted.picture.pixels()[i], b = photographs.left.pixels()[i];
    effort.error += std::pow(a.r - b.r, 2) + std::pow(a.g - b.g, 2) + std::pow(a.b - b.b, 2);
  }
  effort.error = std::sqrt(effort.error / static_cast<double>(painted.picture.pixels().size()));
  return effort;
}

TEST(DualStroke, ReachesTheSameErrorWithFewerStrokes) {
  const Effort single = effort_of(false, 50), dual = effort_of(true, 50);
  EXPECT_LE(dual.error, single.error);
  EXPECT_LT(dual.strokes, 0.65 * single.strokes);
  // As few single strokes do worse.
  const Effort few = effort_of(false, 80);
  EXPECT_GT(few.error, 1.15 * dual.error);
  EXPECT_LT(few.strokes, dual.strokes);
}

TEST(DualStroke, CountsOnceHoweverManyPartsItHas) {
  for (const Propagation propagation : {Propagation::strokes, Propagation::raster, Propagation::independent}) {
    const Painting painting =
        plan_painting(test_scene::photographs(), test_scene::geometry(), small_style(true, 50, propagation));
    std::size_t parts = 0, marks = 0, in_layers = 0;
    for (const Layer& layer : layers_of(painting)) {
      marks += layer.strokes.size();
      in_layers += count_strokes(layer);
      for (const Stroke& stroke : layer.strokes) parts += stroke.is_part ? 1 : 0;
    }
    EXPECT_GT(parts, marks / 3);
    EXPECT_LT(parts, 2 * marks / 3);
    EXPECT_EQ(count_marks(painting).count, marks - parts);
    EXPECT_EQ(in_layers, marks - parts);
    const StrokeMeasures measured = measure_strokes(layers_of(painting), test_scene::geometry());
    EXPECT_EQ(measured.strokes, marks - parts);
    EXPECT_LE(measured.visible_to_both, measured.strokes);
  }
  const Painting single = plan_painting(test_scene::photographs(), test_scene::geometry(), small_style(false, 50));
  std::size_t marks = 0;
  for (const Layer& layer : layers_of(single)) marks += layer.strokes.size();
  EXPECT_EQ(count_marks(single).count, marks);
}

/// Grey bars between bars of two colours that alternate, all about as light as each other.
Image<Rgb8> bars_beside_changing_ones() {
  Image<Rgb8> picture(200, 96);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      constexpr Rgb8 grey{110, 110, 110}, red{200, 60, 60}, green{30, 140, 60};
      picture(x, y) = y % 12 < 6 ? grey : x % 20 < 10 ? red : green;
    }
  return picture;
}

TEST(DualStroke, HasNoHalfOfAColourThatIsUnlikeOneOfItsPlaces) {
  const Image<Rgb8> picture = bars_beside_changing_ones();
  const Image<float> flat(picture.width(), picture.height(), 0);
  const Style style = small_style(true, 30);
  const StrokePainting painting = paint_view(picture, flat, left_eye, style).painting;
  int halves = 0;
  for (std::size_t i = 0; i < painting.layers.size(); ++i) {
    const Layer& layer = painting.layers[i];
    const ReferencePicture reference = make_reference(picture, style.radii_px[i], style);
    for (const Stroke& stroke : layer.strokes) {
      if (stroke.point_count < 2) continue;
      ++halves;
      for (const ControlPoint& point : layer.points_of(stroke)) {
        const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
        const Rgb8 wanted{reference.red(x, y), reference.green(x, y), reference.blue(x, y)};
        EXPECT_TRUE(is_like(stroke.colour, wanted)) << "layer " << i << ", at " << point.x << ", " << point.y;
      }
    }
  }
  EXPECT_GT(halves, 100);
}

TEST(DualStroke, FusesWhereIndependentEyesDoNot) {
  const auto difference = [](Propagation propagation) {
    const PaintedPair painted =
        paint(test_scene::photographs(), test_scene::geometry(), small_style(true, 50, propagation));
    EXPECT_LT(painted.right_bare_share, 0.005);
    return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
  };
  EXPECT_LT(difference(Propagation::strokes), 0.35 * difference(Propagation::independent));
}

}  // namespace wheatstone::dual_stroke_test
