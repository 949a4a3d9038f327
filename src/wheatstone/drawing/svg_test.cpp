#include "wheatstone/drawing/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/fit_curve_internal.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/drawing/visible_strokes_internal.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::svg_test {

using testing::HasSubstr;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// A horizontal stroke across the picture.
void add_stroke(StrokePainting& painting, float y, float radius, Rgb8 colour, float opacity = 1) {
  painting.layers.push_back({.radius_px = radius});
  Layer& layer = painting.layers.back();
  layer.points = {{5, y, 0}, {15, y, 0}, {25, y, 0}, {35, y, 0}};
  layer.strokes = {{.point_count = 4, .radius_px = radius, .opacity = opacity, .colour = colour}};
}

TEST(Svg, LeavesOutStrokesThatAreWhollyHidden) {
  StrokePainting painting{.width = 40, .height = 30};
  add_stroke(painting, 15, 2, {255, 0, 0});
  add_stroke(painting, 15, 5, {0, 255, 0});
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), testing::Not(HasSubstr("#ff0000")));
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), HasSubstr("#00ff00"));
  painting.layers.back().strokes[0].opacity = 0.7f;
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), HasSubstr("#ff0000")) << "it shines through";
  painting.layers.back().strokes[0].opacity = 1;
  painting.layers.back().strokes[0].radius_px = 1.5f;
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), HasSubstr("#ff0000")) << "it shows on either side";
}

TEST(Svg, AStraightStrokeIsOneLineInTenthsOfAPixel) {
  StrokePainting painting{.width = 40, .height = 30};
  add_stroke(painting, 15.04f, 2, {255, 0, 0});
  const std::string svg = svg_of(Painting{painting}, left_eye);
  EXPECT_THAT(svg, HasSubstr("d=\"M50 150l300 0\""));
  EXPECT_THAT(svg, HasSubstr("width=\"40\" height=\"30\" viewBox=\"0 0 400 300\""));
  EXPECT_EQ(count_of(svg, "<svg"), 1u);
}

TEST(Svg, AStrokeWhoseColourChangesHasAGradientFromItsFirstToItsLastPoint) {
  StrokePainting painting{.width = 40, .height = 30};
  add_stroke(painting, 15, 2, {250, 0, 10});
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), testing::Not(HasSubstr("linearGradient")));
  painting.layers.back().strokes[0].change = {-50, 40, 0};
  const std::string svg = svg_of(Painting{painting}, left_eye);
  EXPECT_THAT(svg, HasSubstr(R"(gradientUnits="userSpaceOnUse" x1="50" y1="150" x2="350" y2="150">)"
                             R"(<stop stop-color="#fa000a"/><stop offset="1" stop-color="#c8280a"/>)"));
  EXPECT_THAT(svg, HasSubstr("<path stroke=\"url(#s0)\""));
  // In another view its points lie elsewhere.
  for (ControlPoint& point : painting.layers.back().points) point.disparity = 3;
  EXPECT_THAT(svg_of(Painting{painting}, right_eye), HasSubstr("x1=\"20\" y1=\"150\" x2=\"320\""));
}

TEST(Svg, EachStrokeHasItsOwnGradientAndADotHasNone) {
  StrokePainting painting{.width = 40, .height = 30};
  for (const float y : {5.f, 15.f, 25.f}) {
    add_stroke(painting, y, 2, {100, 100, 100});
    painting.layers.back().strokes[0].change = {20, 20, 20};
  }
  painting.layers.back().strokes[0].point_count = 1;
  const std::string svg = svg_of(Painting{painting}, left_eye);
  EXPECT_EQ(count_of(svg, "<linearGradient"), 2u);
  EXPECT_EQ(count_of(svg, "id=\"s0\""), 1u);
  EXPECT_EQ(count_of(svg, "id=\"s1\""), 1u);
  EXPECT_THAT(svg, HasSubstr("<path stroke=\"#646464\""));
}

TEST(FitCurves, StayWithinTheToleranceWithFewCurves) {
  std::vector<PlanePoint> chain;
  for (int i = 0; i <= 120; ++i) {
    const float t = 0.05f * static_cast<float>(i);
    chain.push_back({20 + 15 * std::cos(t) + 2 * t, 20 + 15 * std::sin(t)});
  }
  for (const float tolerance : {0.5f, 0.1f, 0.02f}) {
    const auto curves = fit_curves(chain, tolerance);
    EXPECT_LE(curves.size(), tolerance < 0.05f ? 14u : 9u) << tolerance;
    double worst = 0;
    for (const PlanePoint& place : chain) {
      double nearest = 1e9;
      for (const BezierCurve& c : curves)
        for (int k = 0; k <= 2000; ++k) {
          const float t = static_cast<float>(k) / 2000, s = 1 - t;
          const float x =
              s * s * s * c.begin.x + 3 * s * s * t * c.first.x + 3 * s * t * t * c.second.x + t * t * t * c.end.x;
          const float y =
              s * s * s * c.begin.y + 3 * s * s * t * c.first.y + 3 * s * t * t * c.second.y + t * t * t * c.end.y;
          nearest = std::min(nearest, std::hypot(static_cast<double>(x - place.x), static_cast<double>(y - place.y)));
        }
      worst = std::max(worst, nearest);
    }
    EXPECT_LE(worst, tolerance + 0.005) << tolerance;
    for (std::size_t i = 1; i < curves.size(); ++i) EXPECT_EQ(curves[i].begin.x, curves[i - 1].end.x);
  }
  EXPECT_TRUE(fit_curves(std::vector<PlanePoint>{{1, 1}, {1, 1}}, 0.1f).empty());
}

/// The painting without the strokes that the view does not see.
Painting without_hidden(const Painting& painting, ViewPosition view, float least_share) {
  const SeenSurfaces seen =
      seen_surfaces(Surfaces(painting.surfaces), view, {width_of(painting), 0, height_of(painting)});
  Painting kept = painting;
  auto& strokes = std::get<StrokePainting>(kept.marks);
  const auto visible = visible_strokes(prepare_marks(strokes), view, seen.hiding, least_share);
  for (std::size_t l = 0; l < strokes.layers.size(); ++l) {
    std::size_t i = 0;
    std::erase_if(strokes.layers[l].strokes, [&](const Stroke&) { return visible[l][i++] == 0; });
  }
  return kept;
}

TEST(Svg, StrokesThatAreLeftOutDoNotShowInThePicture) {
  Style style = style_by_name("expressionist");
  style.background = Background::colour;
  const PaintedPair painted = paint(test_scene::photographs(), test_scene::geometry(), style);
  const Painting kept = without_hidden(painted.painting, left_eye, 1.f / 128);
  const Image<Rgb8> before = draw(painted.painting, left_eye).picture, after = draw(kept, left_eye).picture;
  int worst = 0;
  double sum = 0;
  for (std::size_t i = 0; i < before.pixels().size(); ++i) {
    const Rgb8 a = before.pixels()[i], b = after.pixels()[i];
    const int off = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
    worst = std::max(worst, off);
    sum += off;
  }
  EXPECT_LE(worst, 8);
  EXPECT_LE(sum / static_cast<double>(before.pixels().size()), 0.5);
  std::size_t strokes = 0;
  for (const Layer& layer : std::get<StrokePainting>(kept.marks).layers) strokes += layer.strokes.size();
  const std::string svg = svg_of(painted.painting, left_eye);
  // A surface may hide the middle of a brush whose rim shows.
  EXPECT_LE(count_of(svg, "<path"), strokes);
  EXPECT_GT(count_of(svg, "<path"), strokes - strokes / 20);
  // A pixel of this picture holds no more than 24 bytes of SVG, where every stroke with all its points would take 180.
  EXPECT_LE(svg.size(), 24u * test_scene::width * test_scene::height);
}

TEST(Svg, DiffusionCurvesLieOverTheDrawnView) {
  DiffusionPainting painting{.width = 40, .height = 30};
  painting.points = {{{2, 3, 0}, {200, 0, 0}}, {{20, 3, 0}, {204, 0, 0}}, {{30, 3, 0}, {0, 0, 200}}};
  painting.lines = {{.point_count = 3}};
  const std::string svg = svg_of(Painting{painting}, left_eye, "\x89PNG");
  EXPECT_THAT(svg, HasSubstr("xlink:href=\"data:image/png;base64,iVBORw==\""));
  EXPECT_THAT(svg_of(Painting{painting}, left_eye), testing::Not(HasSubstr("<image")));
  EXPECT_EQ(count_of(svg, "<path"), 2u) << "a piece for each of two colours";
  EXPECT_THAT(svg, HasSubstr("M20 30l180 0 100 0"));
}

}  // namespace wheatstone::svg_test
