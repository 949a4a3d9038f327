// Posterised films and mosaics of films: they must not flicker, and both eyes must still show the same regions.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

#include "scenes/short_film.h"
#include "throws_error.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/still_scene.h"

namespace wheatstone::regions_in_time_test {

constexpr int width = 192, height = 108;

ShortFilm make_film(FilmMotion motion) {
  SyntheticFilmOptions options;
  options.still.width = width;
  options.still.height = height;
  options.still.samples_a_side = 2;
  options.cut = 0;
  options.motion = motion;
  options.noise = 5;
  return film_with_estimated_flow(options, 4);
}

const ShortFilm& walk() {
  static const ShortFilm film = make_film(FilmMotion::walk);
  return film;
}

const ShortFilm& pan() {
  static const ShortFilm film = make_film(FilmMotion::pan);
  return film;
}

Style style_of(std::string_view name) {
  Style style = style_by_name(name);
  style.tile_px = 24;  // so that tiles are not lost among the few pixels
  return style;
}

/// Either kind of painting with its memory.
class Painter {
 public:
  explicit Painter(std::string_view name, TilePlaces places = TilePlaces::follow)
      : style_(style_of(name)), places_(places) {}

  Painting plan(const FilmFrame& frame) {
    Painting painting = wheatstone::plan_frame(frame, style_, {}, memory_).painting;
    if (places_ == TilePlaces::keep) painting.marks = plan_mosaic(frame, style_, kept_tiles_, places_);
    return painting;
  }
  /// For the eyes alone.
  Painting plan_still(const StereoPair& pair, const StereoGeometry& geometry) const {
    return plan_painting(pair, geometry, style_, {}, ViewRange{});
  }
  Painting plan_frame(const ShortFilm& film, std::size_t i, bool afresh = false) {
    const std::vector<View> views = film.scene(i);
    return plan({views, afresh ? nullptr : film.flow_to(i)});
  }

 private:
  Style style_;
  TilePlaces places_;
  PaintingMemory memory_;
  MosaicMemory kept_tiles_;
};

/// E_warp of the left eye's film.
double flicker(const ShortFilm& film, Painter painter, bool afresh = false) {
  TemporalError error;
  Image<Rgb8> before;
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    Image<Rgb8> now = draw(painter.plan_frame(film, i, afresh), left_eye).picture;
    if (i > 0) error.add(before, now, relate_frames(FlowPair{film.frames[i - 1].to_next, film.frames[i].to_previous}));
    before = std::move(now);
  }
  return error.mean();
}

/// How much less than frame by frame.
double flicker_left(const ShortFilm& film, std::string_view name) {
  const double left = flicker(film, Painter(name)) / flicker(film, Painter(name), true);
  testing::Test::RecordProperty(&film == &walk() ? "walk" : "pan", std::to_string(left));
  return left;
}

TEST(Posterise, LeavesLessThanTwoThirdsOfTheFlickerOfFrameByFrame) {
  EXPECT_LT(flicker_left(walk(), "posterise"), 0.67);
  EXPECT_LT(flicker_left(pan(), "posterise"), 0.6);
  // Frame by frame, palettes that tell hues apart flicker half as much as those found in RGB.
  EXPECT_LT(flicker(walk(), Painter("posterise"), true), 0.0033);
  EXPECT_LT(flicker(pan(), Painter("posterise"), true), 0.0022);
}

TEST(Mosaic, LeavesLessThanTwoThirdsOfTheFlickerOfFrameByFrame) {
  EXPECT_LT(flicker_left(walk(), "mosaic"), 0.67);
  EXPECT_LT(flicker_left(pan(), "mosaic"), 0.6);
}

TEST(Mosaic, FlickersWithTilesThatKeepTheirPlacesWhereThePictureMoves) {
  EXPECT_LT(flicker(pan(), Painter("mosaic", TilePlaces::keep)), 0.6 * flicker(pan(), Painter("mosaic"), true));
  EXPECT_GT(flicker(walk(), Painter("mosaic", TilePlaces::keep)), 1.3 * flicker(walk(), Painter("mosaic")));
}

class RegionsInTime : public testing::TestWithParam<std::string_view> {};

TEST_P(RegionsInTime, BeginASceneAsIfNothingHadBeenBefore) {
  Painter used(GetParam()), unused(GetParam());
  used.plan_frame(walk(), 0);
  used.plan_frame(walk(), 1);
  EXPECT_EQ(used.plan_frame(pan(), 0), unused.plan_frame(pan(), 0));
  EXPECT_EQ(used.plan_frame(pan(), 1), unused.plan_frame(pan(), 1));
}

TEST_P(RegionsInTime, BeginWithTheStill) {
  const SyntheticFilmFrame& frame = walk().frames[0];
  const std::vector<View> scene = make_still_scene(frame.pictures, frame.geometry, {});
  const Painting film = Painter(GetParam()).plan({scene, nullptr});
  const Painting still = Painter(GetParam()).plan_still(frame.pictures, frame.geometry);
  EXPECT_EQ(draw(film, left_eye).picture, draw(still, left_eye).picture);
}

TEST_P(RegionsInTime, GiveTheSameBytesOnAnyNumberOfThreads) {
  std::optional<Painting> first;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Painter painter(GetParam());
    painter.plan_frame(walk(), 0);
    painter.plan_frame(walk(), 1);
    const Painting painting = painter.plan_frame(walk(), 2);
    if (!first) first = painting;
    EXPECT_EQ(painting, *first);
  }
}

TEST_P(RegionsInTime, FuseAsWellAsTheStill) {
  Painter painter(GetParam());
  Painting painting;
  for (std::size_t i = 0; i < walk().frames.size(); ++i) painting = painter.plan_frame(walk(), i);
  const Painting afresh = painter.plan_frame(walk(), walk().frames.size() - 1, true);
  const SyntheticFilmFrame& frame = walk().frames.back();
  const auto difference = [&](const Painting& regions) {
    return measure_left_right_difference({draw(regions, left_eye).picture, draw(regions, right_eye).picture},
                                         frame.geometry.left_disparity)
        .mean_absolute;
  };
  EXPECT_LT(difference(painting), 1.05 * difference(afresh));
  // The left eye's own view is drawn without being moved.
  EXPECT_LT(difference(painting), 1.25 * difference(painter.plan_still(frame.pictures, frame.geometry)));
  EXPECT_LT(draw(painting, left_eye).bare_share, 0.005);
  EXPECT_LT(draw(painting, right_eye).bare_share, 0.005);
}

TEST_P(RegionsInTime, LeaveTheEyesBareWithoutWhatOnlyOneSees) {
  Painter painter(GetParam());
  painter.plan_frame(walk(), 0);
  Painting painting = painter.plan_frame(walk(), 1);
  std::erase_if(std::get<RegionPainting>(painting.marks).marks,
                [](const RegionMark& mark) { return mark.reference_view != central_view; });
  EXPECT_GT(draw(painting, left_eye).bare_share, 0.01);
  EXPECT_GT(draw(painting, right_eye).bare_share, 0.01);
}

TEST_P(RegionsInTime, PaintAFilmOfOneView) {
  const Image<float> flat(width, height);
  Painter painter(GetParam());
  for (std::size_t i = 0; i < 2; ++i) {
    const View view{walk().centres[i].picture, flat, {}, central_view};
    const Painting painting = painter.plan({{&view, 1}, walk().flow_to(i)});
    EXPECT_EQ(draw(painting, left_eye).picture, draw(painting, right_eye).picture);
    EXPECT_LT(draw(painting, central_view).bare_share, 0.005);
  }
}

TEST_P(RegionsInTime, RefuseWhatDoesNotFit) {
  Painter painter(GetParam());
  expect_error(ErrorKind::bad_input, "no picture", [&] { painter.plan({}); });
  std::vector<View> views = walk().scene(1);
  const FlowPair small{{Image<float>(3, 3), Image<float>(3, 3)}, {Image<float>(3, 3), Image<float>(3, 3)}};
  expect_error(ErrorKind::bad_input, "flow", [&] { painter.plan({views, &small}); });
  const Image<float> unknown(width, height, std::numeric_limits<float>::quiet_NaN()), other(7, 5);
  views[1].disparity = unknown;
  expect_error(ErrorKind::bad_input, "unknown", [&] { painter.plan({views, nullptr}); });
  views[1].disparity = other;
  expect_error(ErrorKind::bad_input, "7x5", [&] { painter.plan({views, nullptr}); });
}

INSTANTIATE_TEST_SUITE_P(Of, RegionsInTime, testing::Values("posterise", "mosaic"));

TEST(Posterise, KeepsItsPaletteThroughAScene) {
  const Style style = style_of("posterise");
  PosterisedMemory memory;
  std::vector<PaletteColour> before;
  for (std::size_t i = 0; i < walk().frames.size(); ++i) {
    const std::vector<View> views = walk().scene(i);
    plan_posterised({views, walk().flow_to(i)}, style, memory);
    for (std::size_t k = 0; k < before.size(); ++k) {
      EXPECT_LT(std::abs(memory.palette[k].red - before[k].red), 4);
      EXPECT_LT(std::abs(memory.palette[k].green - before[k].green), 4);
      EXPECT_LT(std::abs(memory.palette[k].blue - before[k].blue), 4);
    }
    before = memory.palette;
  }
  EXPECT_EQ(before.size(), 14u);
}

TEST(Mosaic, LeavesTilesOfAStillPictureWhereTheyAre) {
  const Image<float> flat(width, height);
  const View view{walk().centres[0].picture, flat, {}, central_view};
  const FlowPair no_motion{{flat, flat}, {flat, flat}};
  const Style style = style_of("mosaic");
  MosaicMemory memory;
  plan_mosaic({{&view, 1}, nullptr}, style, memory);
  const std::vector<MosaicTile> first = memory.tiles;
  for (int i = 0; i < 3; ++i) plan_mosaic({{&view, 1}, &no_motion}, style, memory);
  const auto count = static_cast<double>(first.size());
  ASSERT_NEAR(static_cast<double>(memory.tiles.size()), count, 0.03 * count);
  std::size_t moved = 0;
  for (const MosaicTile& tile : memory.tiles)
    moved += std::ranges::none_of(
        first, [&](const MosaicTile& other) { return std::hypot(other.x - tile.x, other.y - tile.y) < 1; });
  EXPECT_LT(static_cast<double>(moved), 0.05 * count);
}

static_assert(std::is_trivially_copyable_v<PaletteColour> && std::is_trivially_copyable_v<MosaicTile>);

}  // namespace wheatstone::regions_in_time_test
