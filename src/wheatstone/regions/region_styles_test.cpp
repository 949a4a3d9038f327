// Posterised pictures and mosaics of a small scene: both eyes must show the same regions.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "scenes/two_surfaces.h"
#include "throws_error.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/regions/colour_palette_internal.h"
#include "wheatstone/regions/repair.h"

namespace wheatstone::region_styles_test {

Style small_style(std::string_view name, Propagation propagation = Propagation::strokes) {
  Style style = style_by_name(name);
  style.absolute_radii = true;
  style.propagation = propagation;
  return style;
}

PaintedPair paint_scene(const Style& style) {
  return paint(test_scene::as_photographed(), test_scene::geometry(), style);
}

const RegionPainting& regions_of(const Painting& painting) { return std::get<RegionPainting>(painting.marks); }

double difference_of(const PaintedPair& painted) {
  return measure_left_right_difference(painted.pictures, test_scene::geometry().left_disparity).mean_absolute;
}

class RegionStyle : public testing::TestWithParam<std::string_view> {};

TEST_P(RegionStyle, FusesWhereIndependentEyesDoNot) {
  const double both = difference_of(paint_scene(small_style(GetParam())));
  const double independent = difference_of(paint_scene(small_style(GetParam(), Propagation::independent)));
  RecordProperty("both", std::to_string(both));
  RecordProperty("independent", std::to_string(independent));
  EXPECT_LT(both, 0.35 * independent);
}

TEST_P(RegionStyle, CoversBothEyes) {
  const PaintedPair painted = paint_scene(small_style(GetParam()));
  EXPECT_LT(painted.left_bare_share, 0.005);
  EXPECT_LT(painted.right_bare_share, 0.005);
}

TEST_P(RegionStyle, LeavesTheRightEyeBareWithoutWhatOnlyItSees) {
  Painting painting = paint_scene(small_style(GetParam())).painting;
  std::erase_if(std::get<RegionPainting>(painting.marks).marks,
                [](const RegionMark& mark) { return mark.reference_view == right_eye; });
  EXPECT_GT(draw(painting, right_eye).bare_share, 0.02);
  EXPECT_LT(draw(painting, left_eye).bare_share, 0.005);
}

TEST_P(RegionStyle, GivesTheSameBytesOnAnyNumberOfThreads) {
  PaintedPair first;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    PaintedPair painted = paint_scene(small_style(GetParam()));
    if (first.pictures.left.empty()) first = painted;
    EXPECT_EQ(painted.painting, first.painting);
    EXPECT_EQ(painted.pictures.left, first.pictures.left);
    EXPECT_EQ(painted.pictures.right, first.pictures.right);
  }
}

/// How many marks have points of both surfaces.
std::size_t spanning_marks(const RegionPainting& regions) {
  return static_cast<std::size_t>(std::ranges::count_if(regions.marks, [&](const RegionMark& mark) {
    float least = 1e9f, most = -1e9f;
    for (const Ring& ring : regions.rings_of(mark)) {
      for (const ControlPoint& point : regions.points_of(ring)) {
        least = std::min(least, point.disparity);
        most = std::max(most, point.disparity);
      }
    }
    return most - least > 1;
  }));
}

TEST_P(RegionStyle, NoRegionSpansTwoSurfacesUnlessDepthIsIgnored) {
  Style style = small_style(GetParam());
  const Painting painting = paint_scene(style).painting;
  const RegionPainting& regions = regions_of(painting);
  EXPECT_EQ(spanning_marks(regions), 0u);
  for (const Ring& ring : regions.rings) EXPECT_GE(ring.point_count, 3u);
  style.depth_threshold_px = 100;
  EXPECT_GT(spanning_marks(regions_of(paint_scene(style).painting)), 0u);
}

TEST_P(RegionStyle, StaysWhatItIsOnPicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 7}, {9, 5}}) {
    const StereoPair tiny{Image<Rgb8>(width, height, {9, 99, 199}), Image<Rgb8>(width, height, {9, 99, 199})};
    const PaintedPair painted =
        paint(tiny, geometry_from_left(Image<float>(width, height, 0)), small_style(GetParam()));
    EXPECT_EQ(painted.left_bare_share, 0) << width << "x" << height;
    EXPECT_EQ(painted.pictures.left, painted.pictures.right) << width << "x" << height;
  }
}

TEST_P(RegionStyle, RefusesWhatDoesNotFit) {
  StereoGeometry geometry = test_scene::geometry();
  geometry.left_disparity = Image<float>(3, 3);
  expect_error(ErrorKind::bad_input, "3x3",
               [&] { paint(test_scene::photographs(), geometry, small_style(GetParam())); });
  expect_error(ErrorKind::wrong_usage, "raster", [&] { paint_scene(small_style(GetParam(), Propagation::raster)); });
  expect_error(ErrorKind::wrong_usage, "expected brush strokes", [&] {
    paint_view(test_scene::photographs().left, test_scene::geometry().left_disparity, left_eye,
               small_style(GetParam()));
  });
}

INSTANTIATE_TEST_SUITE_P(Of, RegionStyle, testing::Values("posterise", "mosaic"));

/// A slope of grey, which mean squared errors spend every colour on, with a red dot and a blue one.
Image<Rgb8> slope_with_two_dots() {
  Image<Rgb8> picture(320, 160);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 320; ++x) {
      const auto level = static_cast<std::uint8_t>(20 + x * 210 / 320);
      picture(x, y) = {level, level, level};
    }
  for (int y = 60; y < 72; ++y) {
    std::fill_n(&picture(90, y), 12, Rgb8{190, 90, 90});
    std::fill_n(&picture(200, y), 12, Rgb8{110, 110, 220});
  }
  return picture;
}

TEST(Palette, HasAColourForSmallThingsOfTheirOwn) {
  const Image<Rgb8> picture = slope_with_two_dots();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Rgb8> palette = rounded(find_palette(picture, 8, seed));
    for (const Rgb8 dot : {Rgb8{190, 90, 90}, Rgb8{110, 110, 220}}) {
      const Rgb8 nearest = palette[nearest_colour(palette, dot)];
      EXPECT_LT(std::hypot(nearest.r - dot.r, nearest.g - dot.g, nearest.b - dot.b), 60) << seed;
    }
  }
}

/// A face and a grey coat of the same luminances, from dark to light.
TEST(Palette, TellsSkinFromGreyOfItsLuminance) {
  Image<Rgb8> picture(320, 160);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 320; ++x) {
      const float light = 40 + 160 * static_cast<float>(x % 160) / 160;
      const auto level = [&](float share) { return static_cast<std::uint8_t>(share * light); };
      picture(x, y) = x < 160 ? Rgb8{level(1.18f), level(0.95f), level(0.82f)} : Rgb8{level(1), level(1), level(1)};
    }
  }
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<Rgb8> palette = rounded(find_palette(picture, 8, seed));
    int wrong = 0;
    for (int x = 0; x < 320; ++x) {
      const Rgb8 colour = palette[nearest_colour(palette, picture(x, 80))];
      const bool looks_like_skin = colour.r - colour.b > 0.18f * static_cast<float>(colour.r);
      wrong += looks_like_skin == (x < 160) ? 0 : 1;
    }
    EXPECT_LE(wrong, 60) << seed;  // by distances in RGB 75 to 96; what is left is nearly black
  }
}

TEST(Posterise, ShowsNoMoreColoursThanAskedFor) {
  Style style = small_style("posterise");
  style.colours = 3;
  std::vector<std::uint32_t> colours;
  const Painting painting = paint_scene(style).painting;
  for (const RegionMark& mark : regions_of(painting).marks)
    colours.push_back(mark.colour.r * 65536u + mark.colour.g * 256u + mark.colour.b);
  std::ranges::sort(colours);
  colours.erase(std::unique(colours.begin(), colours.end()), colours.end());
  EXPECT_EQ(colours.size(), 3u);
}

TEST(Posterise, CoversACurvedSurfaceOfOneColour) {
  constexpr int width = 160, height = 60;
  Image<float> disparity(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float from_middle = static_cast<float>(x) / (width / 2.f) - 1;
      disparity(x, y) = 12 - 10 * from_middle * from_middle;
    }
  const Image<Rgb8> grey(width, height, {120, 120, 120});
  const PreparedPainting prepared =
      prepare(plan_painting({grey, grey}, geometry_from_left(std::move(disparity)), small_style("posterise")));
  for (const ViewPosition view : {left_eye, ViewPosition(0.f), right_eye})
    EXPECT_LT(draw(prepared, view).bare_share, 1e-3);
}

TEST(Posterise, IsRepairedByRegionsThatComeAndGoInAFewSteps) {
  constexpr int size = 60;
  Image<Rgb8> photograph(size, size, {40, 60, 160});
  Image<std::uint8_t> spots(size, size);
  for (int y = 5; y < size; y += 15)
    for (int x = 5; x < size; x += 15)
      for (int i = 0; i < 16; ++i) {
        photograph(x + i % 4, y + i / 4) = {220, 200, 60};
        spots(x + i % 4, y + i / 4) = 255;
      }
  RegionPainting painting{size, size, {}, {}, {}};
  painting.marks = {{.colour = {40, 60, 160}}, {.colour = {220, 200, 60}}};
  const std::size_t before = painting.marks.size();
  const Image<float> disparity(size, size, 0);
  const ViewRange about{ViewPosition(0.25f), ViewPosition(0.75f)};
  repair({photograph, spots, disparity, right_eye, left_eye, about}, small_style("posterise"), painting);
  ASSERT_GE(painting.marks.size(), before + 16);
  std::vector<float> first;
  for (const RegionMark& mark : std::span(painting.marks).subspan(before)) {
    EXPECT_TRUE(mark.views.contains(right_eye));
    first.push_back(mark.views.first.eye_separations());
  }
  std::ranges::sort(first);
  EXPECT_GE(first.front(), 0.125f - 1e-6f);
  EXPECT_LE(first.back(), 0.375f + 1e-6f);
  for (std::size_t i = 1; i < first.size(); ++i) EXPECT_LT(first[i] - first[i - 1], 0.1f);
  EXPECT_GT(first.back() - first.front(), 0.15f);
  first.erase(std::unique(first.begin(), first.end()), first.end());
  EXPECT_EQ(first.size(), 4u);
}

/// How far the joints inside a diagonal stripe run along it or across: 1 all, 0 they stand anyhow, −1 none.
double diagonal_order(const RegionPainting& regions) {
  double order = 0, all = 0;
  for (const Ring& ring : regions.rings) {
    const auto points = regions.points_of(ring);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ControlPoint &a = points[i], &b = points[(i + 1) % points.size()];
      constexpr float inside = 20;
      if (std::abs(a.x - a.y) > inside || std::abs(b.x - b.y) > inside) continue;
      const double dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
      order -= std::hypot(dx, dy) * std::cos(4 * std::atan2(dy, dx));
      all += std::hypot(dx, dy);
    }
  }
  return order / all;
}

TEST(Mosaic, TurnsItsTilesAlongTheEdgesOfThePicture) {
  constexpr int size = 120;
  Image<Rgb8> stripe(size, size), flat(size, size, {220, 200, 60});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) stripe(x, y) = std::abs(x - y) < 30 ? Rgb8{220, 200, 60} : Rgb8{40, 60, 160};
  Style style = small_style("mosaic");
  style.tile_px = 12;
  const StereoGeometry geometry = geometry_from_left(Image<float>(size, size, 0));
  EXPECT_GT(diagonal_order(regions_of(paint({stripe, stripe}, geometry, style).painting)), 0.1);
  EXPECT_LT(diagonal_order(regions_of(paint({flat, flat}, geometry, style).painting)), -0.1);
}

TEST(DrawRegions, LeavesHolesAndHidesByDepth) {
  // A far square with a hole, and a nearer one that moves over it.
  RegionPainting painting{20, 20, {}, {}, {}};
  const auto add_square = [&](float low, float high, float disparity) {
    painting.rings.push_back({static_cast<std::uint32_t>(painting.points.size()), 4});
    for (const auto& [x, y] : {std::pair{low, low}, {high, low}, {high, high}, {low, high}})
      painting.points.push_back({x, y, disparity});
  };
  add_square(2, 18, 0);
  add_square(8, 12, 0);
  add_square(14, 16, 4);
  painting.marks = {{.first_ring = 0, .ring_count = 2, .colour = {200, 0, 0}},
                    {.first_ring = 2, .ring_count = 1, .colour = {0, 200, 0}, .disparity = 4}};
  const DrawnView left = draw(Painting{painting}, left_eye), right = draw(Painting{painting}, right_eye);
  EXPECT_EQ(left.picture(15, 15), (Rgb8{0, 200, 0}));
  EXPECT_EQ(right.picture(11, 15), (Rgb8{0, 200, 0}));
  EXPECT_EQ(right.picture(15, 15), (Rgb8{200, 0, 0}));
  EXPECT_EQ(left.bare(10, 10), 255);
  EXPECT_EQ(left.bare(5, 5), 0);
  std::ranges::reverse(painting.marks);  // what is nearer hides what is farther, whatever the order
  EXPECT_EQ(draw(Painting{painting}, right_eye).picture(11, 15), (Rgb8{0, 200, 0}));
}

}  // namespace wheatstone::region_styles_test
