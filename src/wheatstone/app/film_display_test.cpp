// Films for displays with many views.

#include "wheatstone/app/film_presentation.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <string>
#include <vector>

#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_display_test {

namespace fs = std::filesystem;

constexpr int film_width = 128, film_height = 80;

StereoPair eyes_of_frame(int frame, int cut = 0) {
  SyntheticFilmOptions options;
  options.still.width = film_width;
  options.still.height = film_height;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = cut;
  return make_synthetic_film_frame(options, frame).pictures;
}

FilmDisplay small_quilt() {
  return {.views = {.views = 6, .width = 60, .height = 60, .span = 3}, .quilt = QuiltLayout{3, 2}, .screen = {}};
}

RotoscopeOptions options_for(const FilmDisplay& display, const char* style = "impressionist") {
  RotoscopeOptions options;
  options.style = style_by_name(style);
  options.display = display;
  return options;
}

TEST(FilmDisplay, EachPlaceOfAQuiltShowsTheFramesPaintingFromThere) {
  for (const char* style : {"impressionist", "posterise", "mosaic", "diffusion"}) {
    SCOPED_TRACE(style);
    RotoscopeState state;
    const RotoscopeOptions options = options_for(small_quilt(), style);
    RotoscopedFrame frame;
    for (int i = 0; i < 2; ++i) frame = rotoscope_frame(eyes_of_frame(i), options, state);
    ASSERT_TRUE(std::holds_alternative<Image<Rgb8>>(frame.pictures));
    const auto& quilt = std::get<Image<Rgb8>>(frame.pictures);
    ASSERT_EQ(quilt.width(), 180);
    ASSERT_EQ(quilt.height(), 120);
    const DisplayPlan plan = plan_display({film_width, film_height}, state.depth.ends, options.display->views);
    EXPECT_EQ(plan.span, 3);
    const PreparedPainting prepared = prepare(frame.painting, {.placement = plan.presentation.placement});
    const std::vector<Image<Rgb8>> tiles = views_of_quilt(quilt, *options.display->quilt);
    for (std::size_t i = 0; i < tiles.size(); ++i)
      EXPECT_TRUE(draw(prepared, plan.presentation.views[i]).picture == tiles[i]) << i;
    EXPECT_FALSE(tiles.front() == tiles.back());
    EXPECT_LT(frame.worst_bare_share, 0.05) << "the pictures are small, the views far apart";
  }
}

TEST(FilmDisplay, AWholeFrameHasBarsThatAreNotUnpainted) {
  RotoscopeOptions options = options_for(small_quilt());
  options.display->views.framing.whole = true;
  RotoscopeState state;
  const RotoscopedFrame frame = rotoscope_frame(eyes_of_frame(0), options, state);
  EXPECT_LT(frame.worst_bare_share, 0.05);
  for (const Image<Rgb8>& tile : views_of_quilt(std::get<Image<Rgb8>>(frame.pictures), *options.display->quilt)) {
    const auto is_black = [&](int y) { return std::ranges::count(tile.row(y), Rgb8{}) == tile.width(); };
    EXPECT_TRUE(is_black(0) && is_black(8) && is_black(51) && is_black(59));
    EXPECT_FALSE(is_black(16) || is_black(30) || is_black(43));
  }
}

TEST(FilmDisplay, ViewsBesideTheEyesArePlannedFor) {
  RotoscopeState state;
  const RotoscopedFrame frame = rotoscope_frame(eyes_of_frame(0), options_for(small_quilt()), state);
  const ViewRange known = known_views(frame.painting.surfaces);
  EXPECT_EQ(known.first, ViewPosition(-1.5f));
  EXPECT_EQ(known.last, ViewPosition(1.5f));
  RotoscopeState of_eyes;
  const RotoscopedFrame two = rotoscope_frame(eyes_of_frame(0), {}, of_eyes);
  EXPECT_EQ(known_views(two.painting.surfaces).last, right_eye);
  EXPECT_GT(layers_of(frame.painting).back().strokes.size(), layers_of(two.painting).back().strokes.size());
}

double mean_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
  }
  return sum / (3.0 * static_cast<double>(a.pixels().size()));
}

/// How much neighbouring frames differ in a view, on average.
double change_in_view(std::size_t view, bool anew) {
  RotoscopeOptions options = options_for(small_quilt());
  options.anew = anew;
  RotoscopeState state;
  Image<Rgb8> before;
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const Image<Rgb8> quilt = std::get<Image<Rgb8>>(rotoscope_frame(eyes_of_frame(i), options, state).pictures);
    Image<Rgb8> tile = views_of_quilt(quilt, *options.display->quilt)[view];
    if (i > 0) sum += mean_difference(before, tile);
    before = std::move(tile);
  }
  return sum / 3;
}

TEST(FilmDisplay, TheOutermostViewsAreAsSteadyAsTheMiddleOnes) {
  const double middle = change_in_view(2, false) / change_in_view(2, true);
  for (const std::size_t outermost : {0, 5}) {
    const double ratio = change_in_view(outermost, false) / change_in_view(outermost, true);
    RecordProperty("ratio_" + std::to_string(outermost), std::to_string(ratio));
    EXPECT_LT(ratio, 1.15 * middle) << outermost;
    EXPECT_LT(ratio, 0.8) << outermost;
  }
}

TEST(FilmDisplay, ADeeperFrameWidensTheScenesDepthSlowlyAndAFlatterOneDoesNotNarrowIt) {
  SceneDepth scene;
  follow_depth({2, 10}, true, scene);
  follow_depth({4, 9}, false, scene);
  EXPECT_EQ(scene.ends.farthest_px, 2);
  EXPECT_EQ(scene.ends.nearest_px, 10);
  float before = 10;
  for (int frame = 0; frame < 24; ++frame) {
    follow_depth({2, 34}, false, scene);
    EXPECT_GT(scene.ends.nearest_px, before);
    EXPECT_LE(scene.ends.nearest_px - before, 1.001f) << "a 24th of the difference a frame";
    before = scene.ends.nearest_px;
  }
  EXPECT_GT(before, 24);
  EXPECT_EQ(scene.first.nearest_px, 10);
  follow_depth({0, 1}, true, scene);
  EXPECT_EQ(scene.ends.nearest_px, 1) << "a new scene has its own depth";
}

TEST(FilmDisplay, LensesGetThePictureOfAllViews) {
  FilmDisplay display{.views = {.views = 5, .width = 64, .height = 40, .span = 2}, .quilt = {}, .screen = {}};
  display.screen = lenticular_screen_of(find_display("step-5"));
  RotoscopeState state;
  const RotoscopedFrame frame = rotoscope_frame(eyes_of_frame(0), options_for(display), state);
  const DisplayPlan plan = plan_display({film_width, film_height}, state.depth.ends, display.views);
  const std::vector<Image<Rgb8>> views = present(frame.painting, plan.presentation).views;
  EXPECT_TRUE(std::get<Image<Rgb8>>(frame.pictures) == interleave(views, *display.screen));
}

TEST(FilmDisplay, AFilmOfOneEyeIsRefused) {
  RotoscopeState state;
  expect_error(ErrorKind::bad_input, "has one eye", [&] {
    rotoscope_frame({eyes_of_frame(0).left, {}}, options_for(small_quilt()), state);
  });
}

/// A film of both eyes side by side, "a.mkv".
void make_pairs_film(const TemporaryFolder& folder, int frames, int cut) {
  FilmWriter writer(folder / "a.mkv", {.codec = "ffv1", .layout = StereoLayout::left_right});
  for (int i = 0; i < frames; ++i) {
    const StereoPair eyes = eyes_of_frame(i, cut);
    writer.write({put_together(eyes.left, eyes.right, StereoLayout::left_right), i, {1, 25}, 1});
  }
  writer.finish();
}

RotoscopedFilm paint_film(const TemporaryFolder& folder, const RotoscopeFilmOptions& options, const std::string& name,
                          const Progress& progress = {}) {
  StereoFilmReader source = open_stereo_film(folder / "a.mkv");
  return rotoscope_film(source, folder / name, options, progress);
}

TEST(FilmDisplay, AQuiltFilmThatWasStoppedIsTheSameByteForByteOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  make_pairs_film(folder, 6, 3);
  RotoscopeFilmOptions options;
  options.frames = options_for(small_quilt());
  options.writing.preset = "ultrafast";
  options.frames_between_checkpoints = 2;
  paint_film(folder, options, "whole.mp4");
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept",
               [&] { paint_film(folder, options, "o.mp4", stop); });
  EXPECT_FALSE(fs::exists(folder / "o.mp4"));
  options.resume = true;
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(paint_film(folder, options, "o.mp4").resumed_frames, 4);
  EXPECT_TRUE(bytes_of(folder / "o.mp4") == bytes_of(folder / "whole.mp4"));
  const std::vector<Frame> frames = frames_of(folder / "o.mp4");
  ASSERT_EQ(frames.size(), 6u);
  EXPECT_EQ(frames[5].picture.width(), 180);
  EXPECT_EQ(frames[5].picture.height(), 120);
}

TEST(FilmDisplay, ItsDepthIsKeptForGoingOn) {
  RotoscopeState state;
  rotoscope_frame(eyes_of_frame(0), options_for(small_quilt()), state);
  const RotoscopeState read = decode_rotoscope_state(encode_rotoscope_state(state), "state");
  EXPECT_GT(state.depth.ends.nearest_px, state.depth.ends.farthest_px);
  EXPECT_EQ(read.depth.first.farthest_px, state.depth.first.farthest_px);
  EXPECT_EQ(read.depth.first.nearest_px, state.depth.first.nearest_px);
  EXPECT_EQ(read.depth.ends.farthest_px, state.depth.ends.farthest_px);
  EXPECT_EQ(read.depth.ends.nearest_px, state.depth.ends.nearest_px);
}

}  // namespace wheatstone::film_display_test
