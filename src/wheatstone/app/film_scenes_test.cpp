// Films whose scenes are painted apart: by ranks, to the same bytes.

#include "wheatstone/app/film_scenes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "scenes/film_of_scenes.h"
#include "thread_ranks.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone::film_scenes_test {

namespace fs = std::filesystem;

constexpr int film_frames = 9;

/// Three scenes: frames 0 to 2, 3 to 6, 7 and 8.
class SharedFilm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    make_film_of_scenes(file("film.mkv"), film_frames, {3, 7});
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  static StereoFilmReader source() { return open_stereo_film(file("film.mkv")); }

  static RotoscopeFilmOptions usual() {
    RotoscopeFilmOptions options;
    options.frames.depth_budget = 0.03f;
    options.writing = {.preset = "ultrafast", .layout = StereoLayout::left_right};
    options.frames_between_checkpoints = 4;
    return options;
  }

  /// What the first of so many ranks tells.
  static RotoscopedFilm painted_by(int count, const fs::path& output, const RotoscopeFilmOptions& options,
                                   const Progress& progress = {}) {
    RotoscopedFilm film;
    as_ranks(count, [&](const Ranks& ranks) {
      RotoscopeFilmOptions of_rank = options;
      of_rank.ranks = ranks;
      StereoFilmReader looked_at = source(), painted = source();
      of_rank.scenes = find_scenes(looked_at, ranks);
      RotoscopedFilm of_this = rotoscope_film(painted, output, of_rank, progress);
      if (ranks.first()) film = std::move(of_this);
    });
    return film;
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(SharedFilm, HasTheScenesThatItIsPaintedIn) {
  for (const int count : {1, 2, 3}) {
    as_ranks(count, [&](const Ranks& ranks) {
      StereoFilmReader film = source();
      const FilmScenes scenes = find_scenes(film, ranks);
      EXPECT_THAT(scenes.begins, testing::ElementsAre(0, 3, 7));
      EXPECT_EQ(scenes.frames, film_frames);
    });
  }
}

TEST(FilmScenes, CutsAreToldWhereverTheyLieInTheRunsOfRanks) {
  const TemporaryFolder folder;
  make_mono_film_of_scenes(folder / "film.mkv", 40, {16, 33});
  for (const int count : {1, 2, 4}) {
    as_ranks(count, [&](const Ranks& ranks) {
      StereoFilmReader film = open_stereo_film(folder / "film.mkv", StereoLayout::mono);
      const FilmScenes scenes = find_scenes(film, ranks);
      EXPECT_THAT(scenes.begins, testing::ElementsAre(0, 16, 33)) << count;
      EXPECT_EQ(scenes.frames, 40) << count;
    });
  }
}

TEST(FilmScenes, GoToRanksSoThatAllHaveAboutAsMuchToPaint) {
  const FilmScenes film{.begins = {0, 100, 130, 150, 200}, .frames = 260};
  const auto dealt = [&](std::int64_t done, int ranks) {
    std::string text;
    for (const ScenePart& part : deal_out_scenes(film, done, ranks))
      text += fmt::format("{}-{}:{} ", part.begin, part.end, part.rank);
    return text;
  };
  EXPECT_EQ(dealt(0, 1), "0-100:0 100-130:0 130-150:0 150-200:0 200-260:0 ");
  EXPECT_EQ(dealt(0, 2), "0-100:1 100-130:0 130-150:0 150-200:0 200-260:1 ");
  EXPECT_EQ(dealt(120, 2), "120-130:1 130-150:1 150-200:0 200-260:1 ");
  EXPECT_EQ(dealt(260, 2), "");
}

// What goes over to the next frame within a scene does not go over a cut.
TEST(FilmScenes, ArePaintedAlikeWhateverCameBefore) {
  for (const char* style : {"impressionist", "posterise", "mosaic", "diffusion"}) {
    RotoscopeOptions options;
    options.style = style_by_name(style);
    options.depth_budget = 0.03f;
    RotoscopeState after_others, alone;
    for (int frame = 0; frame < 5; ++frame) {
      const RotoscopedFrame a = rotoscope_frame(eyes_of_scenes(frame, {3, 7}), options, after_others);
      if (frame < 3) continue;
      EXPECT_EQ(a.scene_begins, frame == 3);
      const RotoscopedFrame b = rotoscope_frame(eyes_of_scenes(frame, {3, 7}), options, alone);
      EXPECT_EQ(a.painting, b.painting) << style << frame;
      EXPECT_EQ(std::get<StereoPair>(a.pictures).right, std::get<StereoPair>(b.pictures).right) << style << frame;
    }
    // Nor can it later: what is kept of both is the same.
    alone.frames = after_others.frames;
    alone.totals = after_others.totals;
    EXPECT_TRUE(encode_rotoscope_state(alone) == encode_rotoscope_state(after_others)) << style;
  }
}

TEST_F(SharedFilm, HasTheSameBytesAndTellsTheSameOfItself) {
  RotoscopeFilmOptions options = usual();
  options.marks = file("alone_%d.wst");
  StereoFilmReader film = source();
  const RotoscopedFilm alone = rotoscope_film(film, file("alone.mkv"), options);
  ASSERT_EQ(alone.totals.scenes, 3);
  for (const int count : {2, 3, 4}) {
    options.marks = file(fmt::format("by_{}_%d.wst", count));
    const fs::path output = file(fmt::format("by_{}.mkv", count));
    const RotoscopedFilm shared = painted_by(count, output, options);
    EXPECT_TRUE(bytes_of(output) == bytes_of(file("alone.mkv"))) << count;
    for (int frame = 1; frame <= film_frames; ++frame)
      EXPECT_TRUE(bytes_of(file(fmt::format("by_{}_{}.wst", count, frame))) ==
                  bytes_of(file(fmt::format("alone_{}.wst", frame))))
          << count << " ranks, frame " << frame;
    EXPECT_EQ(shared.totals, alone.totals);
    EXPECT_EQ(shared.frames, film_frames);
    EXPECT_EQ(shared.notes, alone.notes);
    EXPECT_FALSE(fs::exists(work_folder_of(output)));
  }
}

TEST_F(SharedFilm, OfADisplayAndOfPicturesAndOfMarksHasTheSameBytes) {
  RotoscopeFilmOptions options = usual();
  options.frames.depth_budget.reset();
  options.frames.style = style_by_name("posterise");
  options.frames.display = FilmDisplay{.views = {.views = 4, .width = 48, .height = 32}, .quilt = QuiltLayout{2, 2}};
  options.writing.layout = StereoLayout::mono;
  const auto expect_same = [&](const std::string& name, const std::string& one_of_them) {
    StereoFilmReader film = source();
    rotoscope_film(film, file("alone_" + name), options);
    painted_by(3, file("shared_" + name), options);
    EXPECT_TRUE(bytes_of(file("shared_" + one_of_them)) == bytes_of(file("alone_" + one_of_them))) << name;
  };
  expect_same("quilt.mp4", "quilt.mp4");
  options.frames.display.reset();
  options.writing.layout = StereoLayout::left_right;
  expect_same("picture_%d.png", "picture_8.png");
  expect_same("marks_%d.wst", "marks_8.wst");
}

TEST_F(SharedFilm, IsGoneOnWithByAnyNumber) {
  RotoscopeFilmOptions options = usual();
  StereoFilmReader film = source();
  rotoscope_film(film, file("whole.mkv"), options);
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  const auto stopped = [&](int count) {
    options.resume = false;
    expect_error(ErrorKind::interrupted, "the first 4 frames are kept in ",
                 [&] { painted_by(count, file("stopped.mkv"), options, stop); });
    EXPECT_FALSE(fs::exists(file("stopped.mkv")));
    for (const auto& entry : fs::directory_iterator(work_folder_of(file("stopped.mkv"))))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
    options.resume = true;
  };
  const auto expect_whole = [&] {
    EXPECT_TRUE(bytes_of(file("stopped.mkv")) == bytes_of(file("whole.mkv")));
    EXPECT_FALSE(fs::exists(file("stopped.mkv.part")));
    fs::remove(file("stopped.mkv"));
  };
  stopped(2);
  EXPECT_EQ(painted_by(3, file("stopped.mkv"), options).resumed_frames, 4);
  expect_whole();
  stopped(2);
  StereoFilmReader again = source();
  EXPECT_EQ(rotoscope_film(again, file("stopped.mkv"), options).resumed_frames, 4);
  expect_whole();
}

TEST_F(SharedFilm, OfWhichARankFailsLeavesNothing) {
  RotoscopeFilmOptions options = usual();
  options.known = [](std::int64_t frame, const StereoPair& eyes) -> KnownFrame {
    if (frame == 4) throw Error(ErrorKind::bad_input, "frame 4 is damaged");
    return {.geometry = {}, .depth = Image<float>(eyes.left.width(), eyes.left.height(), 1)};
  };
  options.marks = file("failed_%d.wst");
  expect_error(ErrorKind::bad_input, "frame 4 is damaged", [&] { painted_by(2, file("failed.mkv"), options); });
  for (const auto& entry : fs::directory_iterator(file("")))
    EXPECT_FALSE(entry.path().filename().string().starts_with("failed")) << entry.path();
}

}  // namespace wheatstone::film_scenes_test
