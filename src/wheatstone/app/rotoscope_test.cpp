#include "wheatstone/app/rotoscope.h"

#include <gmock/gmock.h>

#include <random>

#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file.h"
#include "wheatstone/synthetic/synthetic_film.h"
#include "wheatstone/video/moving_picture_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

StereoPair eyes_of_frame(int frame, int cut = 0, int width = 96, int height = 64) {
  SyntheticFilmOptions options;
  options.still.width = width;
  options.still.height = height;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = cut;
  return make_synthetic_film_frame(options, frame).pictures;
}

RotoscopedFrame next_frame(int frame, RotoscopeState& state) {
  return rotoscope_frame(eyes_of_frame(frame), {}, state);
}

RotoscopeState state_after(int frames) {
  RotoscopeState state;
  for (int frame = 0; frame < frames; ++frame) next_frame(frame, state);
  return state;
}

TEST(RotoscopeStateFile, ReadBackPaintsOnExactlyAsBefore) {
  const TemporaryFolder folder;
  RotoscopeState kept = state_after(3);
  write_rotoscope_state(folder / "state", kept);
  RotoscopeState read = read_rotoscope_state(folder / "state");
  EXPECT_EQ(read.frames, 3);
  EXPECT_EQ(read.totals, kept.totals);
  EXPECT_GT(read.totals.strokes, 0);
  for (int frame = 3; frame < 6; ++frame) {
    const RotoscopedFrame a = next_frame(frame, kept), b = next_frame(frame, read);
    EXPECT_EQ(a.painted.pictures.left, b.painted.pictures.left) << frame;
    EXPECT_EQ(a.painted.pictures.right, b.painted.pictures.right) << frame;
    EXPECT_FALSE(a.scene_begins);
    EXPECT_GT(a.changes.survived, 0) << "nothing was carried: the state was not put to the test";
  }
  EXPECT_EQ(read.totals, kept.totals);
}

TEST(RotoscopeStateFile, WrittenAgainItHasTheSameBytes) {
  const TemporaryFolder folder;
  write_rotoscope_state(folder / "a", state_after(2));
  write_rotoscope_state(folder / "b", read_rotoscope_state(folder / "a"));
  EXPECT_TRUE(bytes_of(folder / "a") == bytes_of(folder / "b"));
}

TEST(RotoscopeStateFile, TheEmptyStateIsReadBack) {
  const TemporaryFolder folder;
  write_rotoscope_state(folder / "a", {});
  const RotoscopeState read = read_rotoscope_state(folder / "a");
  EXPECT_EQ(read.frames, 0);
  EXPECT_TRUE(read.left_before.empty());
  EXPECT_FALSE(read.range.has_value());
}

TEST(RotoscopeStateFile, DamagedInAnyPlaceItIsRefused) {
  const TemporaryFolder folder;
  RotoscopeState state = state_after(1);
  write_rotoscope_state(folder / "state", state);
  const std::string whole = bytes_of(folder / "state");
  const auto refused = [&](const std::string& bytes) {
    put_bytes(folder / "state", bytes);
    expect_error(ErrorKind::bad_input, "state: damaged", [&] { read_rotoscope_state(folder / "state"); });
  };
  for (std::size_t size = 0; size < 200; ++size) refused(whole.substr(0, size));
  for (std::size_t part = 1; part < 40; ++part) refused(whole.substr(0, whole.size() * part / 40));
  refused(whole.substr(0, whole.size() - 1));
  refused(whole + "x");
  std::mt19937 random(7);
  for (int flip = 0; flip < 200; ++flip) {
    // Half of them in front, where the lengths are.
    const std::size_t last = flip % 2 == 0 ? 99 : whole.size() - 1;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, last)(random);
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (flip % 8)));
    refused(bytes);
  }
}

TEST(Rotoscope, ASceneBeginsAtACut) {
  RotoscopeState state;
  std::vector<bool> begins;
  for (int frame = 0; frame < 6; ++frame)
    begins.push_back(rotoscope_frame(eyes_of_frame(frame, 3, 160, 96), {}, state).scene_begins);
  EXPECT_THAT(begins, testing::ElementsAre(true, false, false, true, false, false));
  EXPECT_EQ(state.totals.scenes, 2);
  EXPECT_EQ(state.frames_of_scene, 3);
}

TEST(Rotoscope, OneEyeGivesOneEye) {
  RotoscopeState state;
  for (int frame = 0; frame < 3; ++frame) {
    const RotoscopedFrame painted = rotoscope_frame({moving_picture(96, 64, frame), {}}, {}, state);
    EXPECT_EQ(painted.painted.pictures.left.width(), 96);
    EXPECT_TRUE(painted.painted.pictures.right.empty());
    EXPECT_EQ(painted.scene_begins, frame == 0);
    EXPECT_GT(psnr(painted.painted.pictures.left, moving_picture(96, 64, frame)),
              psnr(painted.painted.pictures.left, moving_picture(96, 64, frame + 20)));
  }
}

TEST(Rotoscope, SizesThatChangeAreRefused) {
  RotoscopeState state = state_after(1);
  expect_error(ErrorKind::bad_input, "the frame is 80x64 pixels, expected 96x64 as before",
               [&] { rotoscope_frame(eyes_of_frame(1, 0, 80, 64), {}, state); });
  expect_error(ErrorKind::bad_input, "the right eye's picture is 80x64 pixels", [&] {
    rotoscope_frame({eyes_of_frame(1).left, eyes_of_frame(1, 0, 80, 64).right}, {}, state);
  });
}

/// A film of one eye, painted into "o.mp4".
RotoscopedFilm paint_film(const TemporaryFolder& folder, const RotoscopeFilmOptions& options,
                          const std::string& name = "o.mp4", const Progress& progress = {}) {
  StereoFilmReader source = open_stereo_film(folder / "a.mp4", StereoLayout::mono);
  return rotoscope_film(source, folder / name, options, progress);
}

TEST(RotoscopeFilm, StoppedWhileItJoinsItJoinsAgain) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  // The last interval is not full: 4 + 2, and one that never closes by itself.
  for (const int between : {4, 48}) {
    RotoscopeFilmOptions options;
    options.frames_between_checkpoints = between;
    const RotoscopedFilm whole = paint_film(folder, options, "whole.mp4");
    const Progress stop = [](std::string_view step, double) {
      if (step == "join") throw Error(ErrorKind::interrupted, "interrupted");
    };
    expect_error(ErrorKind::interrupted, "--resume goes on after the first 6 frames",
                 [&] { paint_film(folder, options, "o.mp4", stop); });
    EXPECT_FALSE(fs::exists(folder / "o.mp4"));
    options.resume = true;
    const RotoscopedFilm resumed = paint_film(folder, options);
    EXPECT_EQ(resumed.frames, 6);
    EXPECT_EQ(resumed.resumed_frames, 6);
    EXPECT_EQ(resumed.totals, whole.totals);
    EXPECT_TRUE(bytes_of(folder / "o.mp4") == bytes_of(folder / "whole.mp4"));
    EXPECT_FALSE(fs::exists(folder / "o.mp4.part"));
    fs::remove(folder / "o.mp4");
  }
}

TEST(RotoscopeFilm, ADamagedRestIsNamedAndNotRemoved) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  RotoscopeFilmOptions options;
  options.frames_between_checkpoints = 2;
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "after the first 4 frames", [&] { paint_film(folder, options, "o.mp4", stop); });
  const fs::path state = folder / "o.mp4.part/state_000000004";
  ASSERT_TRUE(fs::exists(state));
  EXPECT_FALSE(fs::exists(folder / "o.mp4.part/state_000000002")) << "only the last state is kept";
  const std::string whole = bytes_of(state);
  put_bytes(state, whole.substr(0, 100));
  options.resume = true;
  expect_error(ErrorKind::bad_input, "state_000000004: damaged", [&] { paint_film(folder, options); });
  put_bytes(state, whole);
  EXPECT_EQ(paint_film(folder, options).resumed_frames, 4);
}

}  // namespace
}  // namespace wheatstone
