// Films of one eye and their depth.

#include "wheatstone/app/film_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_depth_test {

namespace fs = std::filesystem;

constexpr int film_width = 128, film_height = 80;

SyntheticFilmFrame frame_of_film(int frame) {
  SyntheticFilmOptions options;
  options.still.width = film_width;
  options.still.height = film_height;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = 0;
  return make_synthetic_film_frame(options, frame);
}

float nearest_of(const Image<float>& disparity) { return std::ranges::max(disparity.pixels()); }

/// Columns of two depths, and of one nearer thing from frame to frame.
Image<float> depth_with(float thing) {
  Image<float> depth(film_width, film_height, 50);
  for (int y = 0; y < film_height; ++y) {
    for (int x = 40; x < 80; ++x) depth(x, y) = 100;
    for (int x = 90; x < 110; ++x) depth(x, y) = thing;
  }
  return depth;
}

TEST(FilmDepth, OneSceneHasOneScaleWhateverComesNearer) {
  const Image<Rgb8> picture = moving_picture(film_width, film_height, 0);
  const DisparityFromDepthOptions options{.strength = 0.1f};
  std::optional<InverseDepthRange> scene;
  const auto disparity_of = [&](float thing, bool begins) {
    return make_film_pair(picture, depth_with(thing), options, begins, scene).geometry.left_disparity(60, 40);
  };
  const float first = disparity_of(100, true);
  EXPECT_NEAR(first, 0.1f * film_width, 1e-3);
  float before = first;
  for (int frame = 1; frame < 5; ++frame) {
    const float now = disparity_of(200, false);
    EXPECT_LT(std::abs(now - before), 0.09f * first) << "the scale changes slowly";
    EXPECT_LT(now, before);
    before = now;
  }
  // The naive way: each frame by itself.
  std::optional<InverseDepthRange> none;
  const float alone = make_film_pair(picture, depth_with(200), options, true, none).geometry.left_disparity(60, 40);
  EXPECT_LT(alone, 0.5f * first);
}

TEST(FilmDepth, AFrameWithoutDepthIsFlatAndChangesNothing) {
  const Image<Rgb8> picture = moving_picture(film_width, film_height, 0);
  std::optional<InverseDepthRange> scene;
  const auto disparity_of = [&](const Image<float>& depth, bool begins) {
    return nearest_of(make_film_pair(picture, depth, {}, begins, scene).geometry.left_disparity);
  };
  EXPECT_EQ(disparity_of(Image<float>(film_width, film_height, 0), true), 0);
  EXPECT_FALSE(scene.has_value());
  EXPECT_NEAR(disparity_of(depth_with(100), false), 0.03f * film_width, 1e-3);
  EXPECT_EQ(disparity_of(Image<float>(film_width, film_height, 7), false), 0);
  EXPECT_EQ(scene->nearest, 100);
}

TEST(FilmDepth, TheMadeEyeIsCloserToTheTrueOneThanTheGivenEyeIs) {
  RotoscopeOptions options;
  options.depth.strength = 0;
  RotoscopeState state;
  for (int i = 0; i < 2; ++i) {
    const SyntheticFilmFrame truth = frame_of_film(i);
    const InverseDepthRange range = *inverse_depth_range(truth.geometry.left_disparity, DepthKind::inverse);
    options.depth.strength = (range.nearest - range.farthest) / film_width;
    const KnownFrame known{{}, {}, truth.geometry.left_disparity};
    const RotoscopedFrame frame = rotoscope_frame({truth.pictures.left, {}}, options, state, &known);
    const StereoPair& painted = std::get<StereoPair>(frame.pictures);
    ASSERT_EQ(painted.right.width(), film_width);
    // Depth has no offset: the farthest point has no disparity, which shifts the eye by whole pixels.
    const int shift = static_cast<int>(std::lround(range.farthest));
    Image<Rgb8> shifted = painted.right;
    for (int y = 0; y < film_height; ++y)
      for (int x = 0; x + shift < film_width; ++x) shifted(x, y) = painted.right(x + shift, y);
    EXPECT_GT(psnr_db(shifted, truth.pictures.right), psnr_db(painted.left, truth.pictures.right) + 1) << i;
    EXPECT_EQ(frame.scene_begins, i == 0);
  }
}

/// A film of one eye and its film of depth.
void make_films(const TemporaryFolder& folder, int frames) {
  FilmWriter film(folder / "a.mkv", {.codec = "ffv1"}), depth(folder / "d.mkv", {.codec = "ffv1"});
  for (int i = 0; i < frames; ++i) {
    const SyntheticFilmFrame frame = frame_of_film(i);
    Image<Rgb8> grey(film_width, film_height);
    std::ranges::transform(frame.geometry.left_disparity.pixels(), grey.pixels().begin(), [](float disparity) {
      const auto level = static_cast<std::uint8_t>(std::clamp(15 * disparity, 0.f, 255.f));
      return Rgb8{level, level, level};
    });
    film.write({frame.pictures.left, i, {1, 25}, 1});
    depth.write({std::move(grey), i, {1, 25}, 1});
  }
  film.finish();
  depth.finish();
}

TEST(FilmDepth, ADepthFilmThatWasStoppedWithIsGoneOnWithByteForByte) {
  const TemporaryFolder folder;
  make_films(folder, 6);
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 2;
  options.writing.preset = "ultrafast";
  options.writing.layout = StereoLayout::left_right;
  options.frames.depth_budget = comfortable_parallax_share;
  const auto paint = [&](const std::string& name, const Progress& progress) {
    StereoFilmReader source = open_stereo_film(folder / "a.mkv", StereoLayout::mono);
    const FilmDepth depth =
        depth_of_film(folder / "d.mkv", {folder / "a.mkv", source.facts(), options.reading}, DepthKind::inverse);
    options.known = [depth](std::int64_t frame, const StereoPair& eyes) {
      return KnownFrame{{}, {}, depth(frame, eyes.left)};
    };
    return rotoscope_film(source, folder / name, options, progress);
  };
  paint("whole.mp4", {});
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "the first 4 frames are kept", [&] { paint("o.mp4", stop); });
  options.resume = true;
  EXPECT_EQ(paint("o.mp4", {}).resumed_frames, 4);
  EXPECT_TRUE(bytes_of(folder / "o.mp4") == bytes_of(folder / "whole.mp4"));
  EXPECT_EQ(frames_of(folder / "o.mp4").front().picture.width(), 2 * film_width);
}

TEST(FilmDepth, ItsScaleIsKeptForGoingOn) {
  RotoscopeState state;
  const KnownFrame known{{}, {}, frame_of_film(0).geometry.left_disparity};
  rotoscope_frame({frame_of_film(0).pictures.left, {}}, {}, state, &known);
  const RotoscopeState read = decode_rotoscope_state(encode_rotoscope_state(state), "state");
  ASSERT_TRUE(state.depth_range && read.depth_range);
  EXPECT_EQ(read.depth_range->farthest, state.depth_range->farthest);
  EXPECT_EQ(read.depth_range->nearest, state.depth_range->nearest);
}

}  // namespace wheatstone::film_depth_test
