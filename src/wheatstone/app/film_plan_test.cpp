// Films that are planned first, drawn in parts, and joined: to the same bytes.

#include "wheatstone/app/film_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <random>

#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/app/film_plan_file_internal.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_plan_test {

namespace fs = std::filesystem;

constexpr int film_frames = 5;

/// A film with a cut, wide enough for strokes to be repaired by what the eyes see.
class PlannedFilm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    FilmWriter writer(file("film.mkv"), {.preset = "ultrafast", .layout = StereoLayout::left_right});
    SyntheticFilmOptions options{.still = {.width = 320, .height = 180, .samples_a_side = 1}, .frames = 12, .cut = 5};
    options.scene = FilmScene::beams;
    for (int i = 0; i < film_frames; ++i) {
      const StereoPair eyes = make_synthetic_film_frame(options, i + 2).pictures;
      writer.write({put_together(eyes.left, eyes.right, StereoLayout::left_right), std::int64_t{2} * i, {1, 25}, 2});
    }
    writer.finish();
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path file(const std::string& name) { return *folder_ / name; }

  static RotoscopeFilmOptions usual() {
    RotoscopeFilmOptions options;
    options.writing = {.preset = "ultrafast", .layout = StereoLayout::left_right};
    options.frames_between_checkpoints = 2;
    options.version = "1.2.3";
    return options;
  }

  static RotoscopedFilm paint(const fs::path& output, const RotoscopeFilmOptions& options) {
    StereoFilmReader source = open_stereo_film(file("film.mkv"));
    return rotoscope_film(source, output, options);
  }

  /// Paints the film in one run and by a plan; parts are drawn in any order.
  static void expect_same(const std::string& name, const std::vector<std::string>& files,
                          RotoscopeFilmOptions options) {
    const fs::path whole = file("whole"), parts = file("parts"), plan = file("a.plan");
    for (const fs::path& folder : {whole, parts, plan}) fs::remove_all(folder);
    fs::create_directory(whole);
    fs::create_directory(parts);
    const bool two_films = files.size() == 2;
    if (two_films) options.right_film = whole / files.back();
    const RotoscopedFilm painted = paint(whole / name, options);
    if (two_films) options.right_film = parts / files.back();
    options.plan = plan;
    const RotoscopedFilm planned = paint(parts / name, options);
    EXPECT_EQ(planned.totals.strokes, painted.totals.strokes);
    EXPECT_TRUE(fs::is_empty(parts));
    const FilmPlan read = read_film_plan(plan, options.version);
    EXPECT_EQ(read.frames.size(), std::size_t{film_frames});
    // Segments begin with the frames 1, 3 and 5.
    constexpr std::array<FrameRange, 4> ranges{{{4, 5}, {1, 1}, {2, 2}, {3, 3}}};
    std::int64_t drawn = 0;
    for (const FrameRange& range : ranges) drawn += draw_film_part(plan, read, range).frames;
    EXPECT_EQ(drawn, film_frames);
    EXPECT_EQ(draw_film_part(plan, read, {1, film_frames}).drawn_before, film_frames);
    join_film_parts(plan, read);
    for (const std::string& made : files) EXPECT_TRUE(bytes_of(whole / made) == bytes_of(parts / made)) << made;
    for (const fs::directory_entry& entry : fs::directory_iterator(parts))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(PlannedFilm, DrawnInPartsHasTheBytesOfOneRun) {
  RotoscopeFilmOptions options = usual();
  options.frames.depth_budget = 0.01f;  // the eyes are moved, and a comment says so
  expect_same("o.mp4", {"o.mp4"}, options);
}

using PlannedFilmLong = PlannedFilm;

TEST_F(PlannedFilmLong, OfTheFilmsOwnEyesAndOfLinesHasTheBytesOfOneRun) {
  expect_same("o.mp4", {"o.mp4"}, usual());
  RotoscopeFilmOptions options = usual();
  options.frames.style.marks = Marks::curves;
  expect_same("o.mp4", {"o.mp4"}, options);
}

TEST_F(PlannedFilmLong, ForEachEyeHasTheBytesOfOneRun) {
  expect_same("o_left.mp4", {"o_left.mp4", "o_right.mp4"}, usual());
}

TEST_F(PlannedFilm, OfPicturesAndOfADisplayHasTheBytesOfOneRun) {
  expect_same("o_%04d.png", {"o_0001.png", "o_0003.png", "o_0005.png"}, usual());
  RotoscopeFilmOptions options = usual();
  options.frames.display =
      FilmDisplay{{.views = 4, .width = 42, .height = 56, .framing = {.whole = true}}, QuiltLayout{2, 2}, {}};
  options.writing.layout = StereoLayout::mono;
  expect_same("o.mp4", {"o.mp4"}, options);
}

TEST_F(PlannedFilm, LacksFramesAndSaysWhich) {
  fs::remove_all(file("b.plan"));
  RotoscopeFilmOptions options = usual();
  options.plan = file("b.plan");
  paint(file("o.mp4"), options);
  const FilmPlan plan = read_film_plan(options.plan, options.version);
  draw_film_part(options.plan, plan, {1, 2});
  draw_film_part(options.plan, plan, {5, 5});
  expect_error(ErrorKind::bad_input, "b.plan: frames 3 to 4 are not drawn, expected all 5; draw them with --draw",
               [&] { join_film_parts(options.plan, plan); });
  EXPECT_FALSE(fs::exists(file("o.mp4")));
  EXPECT_FALSE(fs::exists(file("o.mp4.part")));
  for (const FrameRange& range : {FrameRange{0, 2}, {3, 2}, {4, 6}})
    expect_error(ErrorKind::wrong_usage, "b.plan: has the frames 1 to 5, not ",
                 [&] { draw_film_part(options.plan, plan, range); });
  expect_error(ErrorKind::wrong_usage, "b.plan: exists already", [&] { paint(file("o.mp4"), options); });
  fs::remove(options.plan / "marks_000004.wst");
  expect_error(ErrorKind::bad_input, "marks_000004.wst", [&] { draw_film_part(options.plan, plan, {3, 4}); });
}

TEST_F(PlannedFilm, StoppedLeavesNothing) {
  RotoscopeFilmOptions options = usual();
  options.plan = file("stopped.plan");
  StereoFilmReader source = open_stereo_film(file("film.mkv"));
  const Progress stop = [](std::string_view step, double) {
    if (step.starts_with("painting frame 4")) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "interrupted", [&] { rotoscope_film(source, file("s.mp4"), options, stop); });
  for (const fs::directory_entry& entry : fs::directory_iterator(file("film.mkv").parent_path()))
    EXPECT_EQ(entry.path().filename().string().find("stopped"), std::string::npos) << entry.path();
}

TEST(FilmPlanFile, SeedsOfTheFuzzerAreRead) {
  for (const fs::directory_entry& seed : fs::directory_iterator(fs::path(WHEATSTONE_FUZZ_CORPUS) / "film_plan"))
    EXPECT_NO_THROW(decode_film_plan(film_plan_with_checksum(bytes_of(seed.path())), "a seed"))
        << seed.path() << ": make it anew, as the file `plan` without its 16 bytes of head";
}

TEST(FilmPlanFile, DamagedOrOfAnotherVersionIsRefused) {
  const TemporaryFolder folder;
  FilmPlan plan{.version = "1", .film = "o.mp4", .right_film = {}, .writing = {}, .anaglyph = {}, .frames = {}};
  plan.frames = {{.shot = {.views = {left_eye, right_eye}, .quilt = {}, .screen = {}}, .time_base = {1, 25}}};
  const std::string whole = encode_film_plan(plan);
  EXPECT_EQ(decode_film_plan(whole, "p").frames.front().shot.views, plan.frames.front().shot.views);
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_error(ErrorKind::bad_input, "p: is damaged", [&] { decode_film_plan(whole.substr(0, size), "p"); });
  std::mt19937 random(7);
  for (int flip = 0; flip < 200; ++flip) {
    std::string bytes = whole;
    const std::size_t at = std::uniform_int_distribution<std::size_t>(0, whole.size() - 1)(random);
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (flip % 8)));
    expect_error(ErrorKind::bad_input, "p: ", [&] { decode_film_plan(bytes, "p"); });
  }
  const auto refused = [&](const auto& change) {
    FilmPlan changed = plan;
    change(changed.frames.front());
    expect_error(ErrorKind::bad_input, "p: is damaged", [&] { decode_film_plan(encode_film_plan(changed), "p"); });
  };
  refused([](FrameInPlan& frame) { frame.shot.views.clear(); });
  refused([](FrameInPlan& frame) { frame.shot.backgrounds = 1; });
  refused([](FrameInPlan& frame) { frame.shot.quilt = QuiltLayout{3, 1}; });
  refused([](FrameInPlan& frame) { frame.shot.placement.scale = std::numeric_limits<double>::infinity(); });
  refused([](FrameInPlan& frame) { frame.shot.placement.width = 1 << 30; });
  refused([](FrameInPlan& frame) { frame.shot.covered = CoveredPart{0, 0, frame.shot.placement.width + 1, 0}; });
  refused([](FrameInPlan& frame) { frame.shot.covered = CoveredPart{0, -1, 0, 0}; });
  refused([](FrameInPlan& frame) { frame.time_base.denominator = 0; });
  refused([](FrameInPlan& frame) { frame.outgoing = PlannedShowing(); });
  put_bytes(folder / "plan", whole);
  EXPECT_EQ(read_film_plan(folder / "", "1").film, plan.film);
  expect_error(ErrorKind::bad_input, "was planned by Wheatstone 1, expected 2",
               [&] { read_film_plan(folder / "", "2"); });
  fs::remove(folder / "plan");
  expect_error(ErrorKind::bad_input, "is no plan of a film", [&] { read_film_plan(folder / "", "1"); });
}

}  // namespace wheatstone::film_plan_test
