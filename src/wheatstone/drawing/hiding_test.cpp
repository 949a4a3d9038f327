// What a painting's surfaces hide: a mark is seen where the view sees it, pixel by pixel.

#include "wheatstone/drawing/hiding.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/svg.h"

namespace wheatstone::hiding_test {

constexpr int width = 60, height = 24;
constexpr float wall = 2, post = 12;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr Rgb8 red{220, 0, 0}, blue{0, 0, 220};

/// A wall with a post before its middle, seen by the central view as the reference, and what only the eyes see of it.
Surfaces wall_and_post() {
  Image<float> centre(width, height, wall), left(width, height, unknown), right(width, height, unknown);
  for (int y = 0; y < height; ++y) {
    for (int x = 26; x < 34; ++x) centre(x, y) = post;
    for (int x = 27; x < 32; ++x) left(x, y) = wall;
    for (int x = 28; x < 33; ++x) right(x, y) = wall;
  }
  return {{{central_view, KnownRuns(centre)}, {left_eye, KnownRuns(left)}, {right_eye, KnownRuns(right)}}, 2};
}

/// A red band across the wall, as marks of one kind, in the central view.
Painting band_of_strokes() {
  Layer layer{.radius_px = 8};
  for (float x = 4; x < 58; x += 4) layer.points.push_back({x, 12, wall});
  layer.strokes.push_back({.point_count = static_cast<std::uint32_t>(layer.points.size()),
                           .radius_px = 8,
                           .colour = red,
                           .disparity = wall,
                           .reference_view = central_view,
                           .views = all_views});
  return {.marks = StrokePainting{width, height, blue, {layer}}, .surfaces = wall_and_post()};
}

Painting band_of_regions() {
  RegionPainting regions{width, height, {}, {}, {}};
  const auto add = [&](float top, float bottom, Rgb8 colour, float disparity) {
    regions.rings.push_back({static_cast<std::uint32_t>(regions.points.size()), 4});
    for (const auto& [x, y] : {std::pair{2.f, top}, {58.f, top}, {58.f, bottom}, {2.f, bottom}})
      regions.points.push_back({x, y, disparity});
    regions.marks.push_back({.first_ring = static_cast<std::uint32_t>(regions.rings.size() - 1),
                             .ring_count = 1,
                             .colour = colour,
                             .disparity = disparity,
                             .reference_view = central_view,
                             .views = all_views});
  };
  add(4, 20, red, wall);
  return {.marks = regions, .surfaces = wall_and_post()};
}

/// The columns of a row on which a view shows no mark.
std::pair<int, int> hidden_columns(const DrawnView& drawn, int y) {
  int first = width, last = -1;
  for (int x = 6; x < width - 6; ++x) {
    if (drawn.bare(x, y) == 0) continue;
    first = std::min(first, x);
    last = std::max(last, x);
  }
  return {first, last};
}

TEST(Hiding, HidesAMarkPixelByPixelWhereASurfaceLiesBeforeIt) {
  for (const Painting& painting : {band_of_strokes(), band_of_regions()}) {
    // The post moves by 5 pixels more than the wall from view to view; it hides all that is behind it and no more.
    const int slack = std::holds_alternative<RegionPainting>(painting.marks) ? 1 : 0;
    for (const auto& [view, shift] : {std::pair{left_eye, 6}, {central_view, 0}, {right_eye, -6}}) {
      const auto [first, last] = hidden_columns(draw(painting, view), 12);
      EXPECT_EQ(first, 26 + shift + slack) << view.eye_separations();
      EXPECT_EQ(last, 33 + shift - slack) << view.eye_separations();
    }
  }
}

TEST(Hiding, ShowsEachEyeWhatItSees) {
  // Places of the wall, 4 pixels to either side of the post: one eye sees each, and both see what lies farther away.
  const Painting painting = band_of_strokes();
  const auto shows = [&](float column, ViewPosition view) {
    const float x = column - (view - central_view) * wall;
    return draw(painting, view).picture(static_cast<int>(x), 12) == red;
  };
  EXPECT_TRUE(shows(10.5f, left_eye) && shows(10.5f, right_eye));
  EXPECT_TRUE(shows(36.5f, right_eye));
  EXPECT_FALSE(shows(36.5f, left_eye));
  EXPECT_TRUE(shows(23.5f, left_eye));
  EXPECT_FALSE(shows(23.5f, right_eye));
}

TEST(Hiding, TakesLinesOffWhatLiesBeforeThem) {
  DiffusionPainting curves{width, height, {}, {}};
  const auto add = [&](float y, Rgb8 colour, float from, float to, float disparity) {
    curves.lines.push_back({static_cast<std::uint32_t>(curves.points.size()), 2, central_view, all_views});
    for (const float x : {from, to}) curves.points.push_back({{x, y, disparity}, colour});
  };
  add(12.5f, red, 4, 56, wall);
  add(12.5f, blue, 26, 34, post);
  const Painting painting{.marks = curves, .surfaces = wall_and_post()};
  for (const auto& [view, shift] : {std::pair{left_eye, 6}, {central_view, 0}, {right_eye, -6}}) {
    const Image<Rgb8> drawn = draw(painting, view).picture;
    EXPECT_EQ(drawn(30 + shift, 12), blue) << view.eye_separations();
    EXPECT_EQ(drawn(22 + shift, 12), red) << view.eye_separations();
    EXPECT_EQ(drawn(38 + shift, 12), red) << view.eye_separations();
  }
}

/// A red line on the wall and a blue one on the post, from top to bottom.
Painting upright_lines(float on_wall, float on_post) {
  DiffusionPainting curves{width, height, {}, {}};
  for (const ColourPoint& at : {ColourPoint{{on_wall, 4, wall}, red}, ColourPoint{{on_post, 4, post}, blue}}) {
    curves.lines.push_back({static_cast<std::uint32_t>(curves.points.size()), 2, central_view, all_views});
    curves.points.push_back(at);
    curves.points.push_back({{at.at.x, 20, at.at.disparity}, at.colour});
  }
  return {.marks = curves, .surfaces = wall_and_post()};
}

TEST(Hiding, TakesALineAwayOnceASurfaceHasComeOverIt) {
  const auto is_seen = [](float on_wall, float from) {
    const Image<Rgb8> drawn = draw(upright_lines(on_wall, 30.5f), ViewPosition(from)).picture;
    return std::ranges::any_of(drawn.row(12), [](Rgb8 colour) { return colour.r > 100; });
  };
  // From view to view the post, which ends at 34, moves by 10 pixels more than the wall.
  EXPECT_TRUE(is_seen(35, 0) && is_seen(35, -0.05f));
  EXPECT_FALSE(is_seen(35, -0.3f)) << "its colour would spread over the post from within";
  // A line that lies a pixel within the surface's edge is seen where it was planned, since edges are not known better.
  EXPECT_TRUE(is_seen(33, 0) && is_seen(33, 0.2f));
  EXPECT_FALSE(is_seen(33, -0.2f));
}

TEST(Hiding, LetsALineBesideTheViewColourIt) {
  Painting painting = upright_lines(2.5f, 30.5f);
  painting.surfaces = {};
  const auto at_the_left = [&](float from) { return draw(painting, ViewPosition(from)).picture(0, 12).r; };
  EXPECT_GT(at_the_left(0.5f), 150);
  EXPECT_GT(at_the_left(3 / wall), 150) << "the line lies half a pixel beside the view";
  EXPECT_EQ(at_the_left(12 / wall), 128) << "no line is near";
}

TEST(Hiding, WithoutSurfacesAMarkIsDrawnInTheViewsThatItNames) {
  Painting painting = band_of_strokes();
  painting.surfaces = {};
  EXPECT_EQ(hidden_columns(draw(painting, left_eye), 12).second, -1);
  std::get<StrokePainting>(painting.marks).layers[0].strokes[0].views = {left_eye, central_view};
  EXPECT_EQ(hidden_columns(draw(painting, left_eye), 12).second, -1);
  EXPECT_EQ(draw(painting, right_eye).bare_share, 1);
}

/// A dot that was planned in the right eye, over the band or in a hole of it.
Painting with_dot(float x, float disparity, bool over_hole) {
  Painting painting = band_of_strokes();
  Layer& layer = std::get<StrokePainting>(painting.marks).layers[0];
  if (over_hole) layer.strokes[0].point_count = 4;
  layer.strokes.push_back({.first_point = static_cast<std::uint32_t>(layer.points.size()),
                           .point_count = 1,
                           .radius_px = 3,
                           .colour = {0, 220, 0},
                           .disparity = disparity,
                           .reference_view = right_eye,
                           .views = all_views});
  layer.points.push_back({x, 12, disparity});
  return painting;
}

TEST(Hiding, WhatAnotherViewPlannedOnlyFillsGapsWhereTheReferenceViewShowsTheSurface) {
  const Rgb8 green{0, 220, 0};
  EXPECT_EQ(draw(with_dot(44.5f, wall, false), right_eye).picture(44, 12), red);
  EXPECT_EQ(draw(with_dot(44.5f, wall, true), right_eye).picture(44, 12), green);
  // To the right of the post there is a strip of the wall that the central view does not show.
  EXPECT_EQ(draw(with_dot(30.5f, wall, false), right_eye).picture(30, 12), green);
  // From the left eye it stands at 32.5, where the post begins at 32.
  EXPECT_NE(draw(with_dot(30.5f, wall, false), left_eye).picture(33, 12), green);
}

TEST(Hiding, IsTheSameWithEveryInstructionSet) {
  const Painting painting = with_dot(30.5f, wall, false);
  const Image<Rgb8> best = draw(painting, right_eye).picture;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(draw(painting, right_eye).picture, best) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(Hiding, CutsAStrokeOfAnSvgDocument) {
  const std::string svg = svg_of(band_of_strokes(), central_view);
  std::size_t moves = 0;
  for (std::size_t at = svg.find('M'); at != std::string::npos; at = svg.find('M', at + 1)) ++moves;
  EXPECT_EQ(moves, 2u) << svg;
}

}  // namespace wheatstone::hiding_test
