#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

#include "cli/run.h"
#include "command_line.h"
#include "command_table.h"
#include "content.h"
#include "script.h"

#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::viewer::film_test {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int frames = 30;
constexpr int width = 96, height = 64;

/// An eye's picture of a film whose brightness tells the frame.
Image<Rgb8> eye_of(int frame, bool right) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture(x, y) = {static_cast<std::uint8_t>(8 * frame), static_cast<std::uint8_t>(right ? 200 : 20),
                       static_cast<std::uint8_t>(2 * x)};
  return picture;
}

/// Writes a film without loss, 25 frames a second.
void write_film(const fs::path& path, StereoLayout layout, const std::function<Image<Rgb8>(int)>& picture,
                int count = frames) {
  FilmWriter writer(path, {.codec = "ffv1", .layout = layout, .frame_rate = {25, 1}});
  for (int i = 0; i < count; ++i) writer.write({picture(i), i, {1, 25}, 1});
  writer.finish();
}

Image<Rgb8> both_eyes(int frame) {
  return put_together(eye_of(frame, false), eye_of(frame, true), StereoLayout::left_right);
}

/// A viewer in which a film is open that is shown as it is.
class OpenFilm : public testing::Test {
 protected:
  OpenFilm() {
    write_film(folder / "film.mkv", StereoLayout::left_right, both_eyes);
    open(folder / "film.mkv");
  }
  void open(const fs::path& path) {
    viewer.set_viewport({2 * width, height});
    run_line(viewer, "mode left-right");
    run_command(viewer, find_command("open"), {path.string()});
    // What is opened is painted: not here.
    while (viewer.session().opening && !viewer.session().film) {
      viewer.collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    run("film-painting off");
    EXPECT_FALSE(viewer.session().message_is_error) << viewer.session().message;
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  /// Shows what plays for so long, as a window does.
  void watch(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      viewer.collect();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  const FilmStatus& film() const { return *viewer.session().film; }
  /// The frame that the picture shows.
  int seen() const { return (viewer.frame()->picture(width / 2, height / 2).r + 4) / 8; }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(OpenFilm, ShowsBothEyesOfItsFirstFrame) {
  EXPECT_EQ(viewer.session().opened.kind, "film");
  EXPECT_EQ(film().frame, 0);
  EXPECT_NEAR(film().duration_s, frames / 25., 0.05);
  EXPECT_EQ(viewer.frame()->picture, both_eyes(0));
}

TEST_F(OpenFilm, IsSearchedAndGoneThroughFrameByFrame) {
  const auto expect_frame = [&](std::string_view line, int frame) {
    run(line);
    EXPECT_EQ(film().frame, frame) << line;
    EXPECT_EQ(seen(), frame) << line;
    EXPECT_NEAR(film().seconds, frame / 25., 1e-3) << line;
  };
  expect_frame("frame-step", 1);
  expect_frame("seek-to 0.6", 15);
  expect_frame("frame-step", 16);
  expect_frame("frame-back", 15);
  expect_frame("frame-back", 14);
  expect_frame("seek -0.4", 4);
  expect_frame("seek 0.2", 9);
  expect_frame("seek-to 99", frames - 1);
  expect_frame("frame-step", frames - 1);
  expect_frame("frame-back", frames - 2);
  expect_frame("seek -99", 0);
  expect_frame("frame-back", 0);
}

TEST_F(OpenFilm, PlaysInItsOwnTimeAndStandsAtItsEnd) {
  const auto start = std::chrono::steady_clock::now();
  run_line(viewer, "play");
  watch(0.4);
  run("pause");
  const double passed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(film().frame, 2);
  EXPECT_LE(static_cast<double>(film().frame), passed_s * 25 + 1);
  EXPECT_FALSE(film().plays);
  EXPECT_EQ(seen(), film().frame);
  const auto paused_at = film().frame;
  watch(0.1);
  EXPECT_EQ(film().frame, paused_at);
  run_line(viewer, "play");
  for (int i = 0; i < 100 && film().plays; ++i) watch(0.05);
  EXPECT_FALSE(film().plays);
  EXPECT_EQ(film().frame, frames - 1);
  run_line(viewer, "play");
  watch(0.2);
  EXPECT_LT(film().frame, frames - 1) << "from the beginning again";
}

TEST_F(OpenFilm, GoesOnAndBackByTheKeysThatMoveTheHeadWhereItStands) {
  run("head-right");
  EXPECT_GT(viewer.session().state.head, 0);
  const float head = viewer.session().state.head;
  run("seek-to 0.8");
  run_line(viewer, "play");
  run_line(viewer, "head-left");
  watch(0.1);
  EXPECT_EQ(viewer.session().state.head, head);
  EXPECT_LT(film().frame, 19);
}

TEST_F(OpenFilm, IsToldByPrintAndClosedAtOnce) {
  run("seek-to 0.4");
  EXPECT_THAT(state_json(viewer), HasSubstr(R"("film":{"frame":10,"seconds":0.4,"playing":false})"));
  run_line(viewer, "play");
  watch(0.05);
  const auto start = std::chrono::steady_clock::now();
  run_line(viewer, fmt::format("open \"{}\"", (folder / "film.mkv").string()));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(50));
  EXPECT_FALSE(viewer.session().film);
  EXPECT_THAT(command_line_of(viewer.session()), testing::IsEmpty());
}

TEST_F(OpenFilm, MayBeNumberedPicturesOrAFilmAnEyeOrOfOneEyeOrOfQuilts) {
  for (int i = 0; i < 4; ++i) {
    write_image(folder / fmt::format("left_{}.png", i), eye_of(i, false));
    write_image(folder / fmt::format("right_{}.png", i), eye_of(i, true));
  }
  open((folder / "left_%d.png").string() + "," + (folder / "right_%d.png").string());
  run("frame-step");
  EXPECT_EQ(viewer.frame()->picture, both_eyes(1));
  write_film(
      folder / "one_left.mkv", StereoLayout::mono, [](int i) { return eye_of(i, false); }, 5);
  write_film(
      folder / "one_right.mkv", StereoLayout::mono, [](int i) { return eye_of(i, true); }, 5);
  EXPECT_TRUE(are_eyes_of_one(folder / "one_left.mkv", folder / "one_right.mkv"));
  EXPECT_FALSE(are_eyes_of_one(folder / "one_left.mkv", folder / "film.mkv"));
  run_command(viewer, find_command("open"), {folder / "one_left.mkv", folder / "one_right.mkv"});
  watch(0.2);
  run("film-painting off");
  EXPECT_EQ(viewer.frame()->picture, both_eyes(0));
  open(folder / "one_right.mkv");
  EXPECT_TRUE(std::holds_alternative<ViewsContent>(viewer.session().opened.content));
  write_film(folder / "f_qs2x1a1.5.mkv", StereoLayout::mono, both_eyes, 3);
  open(folder / "f_qs2x1a1.5.mkv");
  EXPECT_EQ(viewer.frame()->picture, both_eyes(0));
}

/// Frames of a scene that moves, packed.
void write_scene(const fs::path& path, int count) {
  write_film(
      path, StereoLayout::left_right,
      [](int i) {
        const SyntheticFilmFrame frame =
            make_synthetic_film_frame({.still = {.width = 128, .height = 96, .samples_a_side = 1}}, i);
        return put_together(frame.pictures.left, frame.pictures.right, StereoLayout::left_right);
      },
      count);
}

/// A film of slices: one plane of a level that tells the frame, before the screen, and one behind it.
void write_slice_film(const fs::path& folder, int count) {
  for (int i = 0; i < count; ++i) {
    const auto light = static_cast<float>(i + 1) / static_cast<float>(count);
    SliceStack stack{.width = width, .height = height, .span = 2};
    for (const float parallax_px : {-4.f, 4.f}) {
      Slice& slice = stack.slices.emplace_back(Slice{.parallax_px = parallax_px});
      slice.pixels = Image<LinearRgba>(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          slice.pixels(x, y) =
              parallax_px < 0 ? LinearRgba{light, 0, 0, 0} : LinearRgba{0, x % 9 == 0 ? 1.f : 0.f, 0, 0};
    }
    write_slices(folder / fmt::format("s_{:04}.exr", i + 1), stack);
  }
}

TEST_F(OpenFilm, MayBeNumberedSlicesWhoseDepthIsChosenWhileTheyPlay) {
  write_slice_film(folder / ".", frames);
  open(folder / "s_%04d.exr");
  EXPECT_EQ(viewer.session().opened.kind, "film of slices");
  EXPECT_NEAR(film().duration_s, frames / 24., 1e-9);
  run("mode left-right");
  const auto red = [&] { return viewer.frame()->picture(width / 2, height / 2).r; };
  const int first = red();
  for (const auto& [line, frame] : {std::pair("frame-step", 1),
                                    {"seek-to 0.5", 12},
                                    {"frame-back", 11},
                                    {"seek-to 99", frames - 1},
                                    {"seek -99", 0}}) {
    run(line);
    EXPECT_EQ(film().frame, frame) << line;
    EXPECT_EQ(red() > first, frame > 0) << line;
  }
  Image<Rgb8> before = viewer.frame()->picture;
  for (const char* line : {"near 60", "far 90", "depth-mapping 0:-20,1:5", "zero-parallax 3", "focus 0.5,0.5"}) {
    run(line);
    EXPECT_NE(viewer.frame()->picture, before) << line;
    before = viewer.frame()->picture;
  }
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("--depth-mapping 0:-20,1:5"));
  EXPECT_THAT(command_line_of(viewer.session()), HasSubstr("-o film.mp4"));
  run("mode right");
  EXPECT_NE(viewer.frame()->picture, before);
  run_line(viewer, "play");
  watch(0.3);
  run("pause");
  EXPECT_GT(film().frame, 1);
  expect_error(ErrorKind::wrong_usage, "a film of slices is not painted",
               [&] { run_line(viewer, fmt::format("paint-film {}", (folder / "out.mp4").string())); });
  // A hole between the numbers is told, not played over.
  fs::remove(folder / "s_0007.exr");
  run_line(viewer, fmt::format("open \"{}\"", (folder / "s_%04d.exr").string()));
  viewer.wait();
  EXPECT_THAT(viewer.session().message, HasSubstr("s_0007.exr"));
}

TEST(Film, IsPaintedWhereItStandsAndShownAsItIsWhereItPlays) {
  const TemporaryFolder folder;
  write_scene(folder / "scene.mkv", 3);
  Viewer viewer;
  run_line(viewer, fmt::format("open \"{}\"", (folder / "scene.mkv").string()));
  viewer.wait();
  const auto painting = [&] { return std::get<PaintedContent>(viewer.session().opened.content).painting; };
  ASSERT_TRUE(painting());
  const float zero_parallax_px = 3;
  run_line(viewer, "zero-parallax 3");
  viewer.wait();
  const auto first = painting();
  run_line(viewer, "frame-step");
  viewer.wait();
  EXPECT_EQ(viewer.session().film->frame, 1);
  ASSERT_TRUE(painting());
  EXPECT_NE(painting(), first);
  EXPECT_EQ(viewer.session().state.adjustment.zero_parallax_px, zero_parallax_px) << "stays from frame to frame";
  run_line(viewer, "play");
  viewer.collect();
  for (int i = 0; i < 100 && viewer.session().film->frame == 1; ++i) {
    viewer.collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(viewer.session().film->frame, 2);
  viewer.wait();
  EXPECT_TRUE(painting()) << "the last frame stands again";
}

TEST(Film, IsPaintedWholeAsRotoscopeDoes) {
  const TemporaryFolder folder;
  write_scene(folder / "scene.mkv", 3);
  Viewer viewer;
  run_line(viewer, fmt::format("open \"{}\"", (folder / "scene.mkv").string()));
  run_line(viewer, "style posterise");
  viewer.wait();
  run_line(viewer, fmt::format("paint-film \"{}\"", (folder / "shown.mp4").string()));
  ASSERT_TRUE(viewer.session().whole_film);
  expect_error(ErrorKind::wrong_usage, "being painted", [&] { run_line(viewer, "paint-film other.mp4"); });
  viewer.wait();
  EXPECT_THAT(viewer.session().message, HasSubstr("painted 3 frames"));
  Words words = words_of(command_line_of(viewer.session()));
  ASSERT_EQ(words[1], "rotoscope");
  words.erase(words.begin());
  words.back() = folder / "painted.mp4";
  std::ostringstream output, errors;
  ASSERT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
  constexpr std::size_t longest = 1 << 24;
  const bool is_same =
      read_whole_file(folder / "shown.mp4", longest) == read_whole_file(folder / "painted.mp4", longest);
  EXPECT_TRUE(is_same);
}

TEST(Film, LeavesNothingWhereItsPaintingIsCancelled) {
  const TemporaryFolder folder;
  write_scene(folder / "scene.mkv", 12);
  Viewer viewer;
  run_line(viewer, fmt::format("open \"{}\"", (folder / "scene.mkv").string()));
  viewer.wait();
  run_line(viewer, fmt::format("paint-film \"{}\"", (folder / "shown.mp4").string()));
  run_line(viewer, "cancel");
  viewer.wait();
  EXPECT_FALSE(viewer.session().whole_film);
  EXPECT_FALSE(viewer.session().message_is_error) << viewer.session().message;
  EXPECT_FALSE(fs::exists(folder / "shown.mp4"));
  EXPECT_FALSE(fs::exists(folder / "shown.mp4.part"));
  run_line(viewer, "paint-film /dev/null/at/all/shown.mp4");
  viewer.wait();
  EXPECT_TRUE(viewer.session().message_is_error);
}

}  // namespace wheatstone::viewer::film_test
