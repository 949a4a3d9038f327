#include "viewer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

#include "cli/run.h"
#include "command_line.h"
#include "command_table.h"
#include "content.h"
#include "depth_seen.h"
#include "inputs.h"
#include "script.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::viewer_test {

using testing::HasSubstr;
using testing::IsEmpty;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 240, .height = 160, .samples_a_side = 1});
  return made;
}

/// A painting of the still, from its exact geometry.
const Painting& painting() {
  static const Painting planned = plan_painting(still().pictures, still().geometry, {});
  return planned;
}

/// A viewer in which the painting is open.
class OpenPainting : public testing::Test {
 protected:
  OpenPainting() {
    write_painting(folder / "still.wst", painting());
    viewer.session().items.push_back({folder / "still.wst"});
    viewer.set_viewport({240, 160});
    viewer.open(0);
    viewer.wait();
  }
  void run(std::string_view line) {
    run_line(viewer, line);
    viewer.wait();
  }
  const Image<Rgb8>& picture() const { return viewer.frame()->picture; }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(OpenPainting, AClickBringsWhatLiesThereOntoTheScreen) {
  run("separation 1");
  run("mode left");
  double worst = 0;
  for (int y = 20; y < 160; y += 45)
    for (int x = 40; x < 220; x += 45) {
      const std::optional<PlaceInView> place = place_at(viewer.frame()->places, x + 0.5, y + 0.5);
      ASSERT_TRUE(place);
      run(fmt::format("zero-parallax-at {} {}", x + 0.5, y + 0.5));
      const int column = static_cast<int>(place->x), row = static_cast<int>(place->y);
      if (!still().geometry.left_disparity.contains(column, row)) continue;
      const double truth = still().geometry.left_disparity(column, row);
      worst = std::max(worst, std::abs(viewer.session().state.adjustment.zero_parallax_px - truth));
    }
  EXPECT_LE(worst, 0.5);
}

TEST_F(OpenPainting, WhatIsOnTheScreenPlaneLiesInTheSamePlaceForBothEyes) {
  run("separation 1");
  run("mode left-right");
  run("zero-parallax 9.4");
  const std::vector<ViewPlace>& places = viewer.frame()->places;
  ASSERT_EQ(places.size(), 2u);
  // A point of that disparity lies at x in the left view and at x - 9.4 in the right one.
  const double on_left = places[0].origin_x + places[0].scale * 100;
  const double on_right = places[1].origin_x + places[1].scale * (100 - 9.4);
  EXPECT_NEAR(on_left, on_right, 0.5);
}

TEST_F(OpenPainting, IsShownAsItIsDrawn) {
  run("separation 1");
  run("mode left");
  run("zero-parallax 0");
  EXPECT_EQ(picture(), draw(painting(), left_eye).picture);
  run("finest-layer 0");
  EXPECT_EQ(picture(), draw(prepare(painting(), {.slicing = {.finest_layer = 0}}), left_eye).picture);
  run("more-detail");
  run("more-detail");
  EXPECT_EQ(picture(), draw(painting(), left_eye).picture);
}

TEST_F(OpenPainting, IsSlicedByAPlaneThatMoves) {
  run("separation 1");
  run("mode left");
  run("zero-parallax 0");
  const auto sliced_at = [&](const char* depths, SliceKeeps keeps = SliceKeeps::back) {
    const Slicing slicing{.depths = parse_slice_depths(depths, "depths"), .keeps = keeps};
    return draw(prepare(painting(), {.slicing = slicing}), left_eye).picture;
  };
  run("slice");
  EXPECT_EQ(picture(), sliced_at("50%"));
  EXPECT_NE(picture(), draw(painting(), left_eye).picture);
  run("slice-keep front");
  EXPECT_EQ(picture(), sliced_at("50%", SliceKeeps::front));
  run("slice-depth 20%,40%");
  run("slice-keep back");
  EXPECT_EQ(picture(), sliced_at("20%,40%"));
  run("slice-farther");
  EXPECT_EQ(picture(), sliced_at("22%,40%"));
  run("slice");
  EXPECT_EQ(picture(), draw(painting(), left_eye).picture);
}

TEST_F(OpenPainting, FollowsTheHead) {
  run("mode left");
  run("zero-parallax 0");
  const Image<Rgb8> before = picture();
  run("head 0.3");
  EXPECT_NE(picture(), before);
  run("separation 0");
  EXPECT_EQ(picture(), draw(painting(), ViewPosition(0.3)).picture);
}

TEST_F(OpenPainting, IsInterleavedForALenticularScreenAsPackAndPaintDoIt) {
  run("display step-9");
  run("zero-parallax 8");
  const LenticularScreen screen = find_lenticular("step-9");
  viewer.set_viewport({screen.width, screen.height});
  run("mode lenticular");
  std::ostringstream output, errors;
  const std::vector<std::string> words{"paint", folder / "still.wst", "--display", "step-9", "--zero-parallax", "8",
                                       "-o",    folder / "screen.png"};
  ASSERT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
  EXPECT_EQ(picture(), read_image(folder / "screen.png"));
}

TEST_F(OpenPainting, UndoesAndRedoesWhatWasSet) {
  run("zero-parallax 5");
  run("mode left-right");
  run("pan 10 10");
  run("undo");
  EXPECT_EQ(viewer.session().state.mode, "left");
  EXPECT_NE(viewer.session().state.framed.pan_x, 0) << "where one looks is not a parameter";
  run("undo");
  EXPECT_NE(viewer.session().state.adjustment.zero_parallax_px, 5);
  run("redo");
  EXPECT_EQ(viewer.session().state.adjustment.zero_parallax_px, 5);
}

TEST_F(OpenPainting, ZoomsAroundThePointer) {
  run("mode left");
  run("actual-size");
  const PlaceInView before = *place_at(viewer.frame()->places, 60, 50);
  run("zoom-at 2 60 50");
  const PlaceInView after = *place_at(viewer.frame()->places, 60, 50);
  EXPECT_NEAR(before.x, after.x, 1);
  EXPECT_NEAR(before.y, after.y, 1);
  EXPECT_DOUBLE_EQ(viewer.frame()->scale, 2);
}

TEST_F(OpenPainting, ZoomsByWhatWasSetAndNotByWhatIsDrawnYet) {
  run("actual-size");
  for (const char* line : {"zoom-at 2 60 50", "zoom-at 2 60 50", "zoom-at 0.5 60 50", "zoom-at 0.5 60 50"})
    run_line(viewer, line);
  EXPECT_DOUBLE_EQ(viewer.session().state.framed.zoom, 1);
  EXPECT_NEAR(viewer.session().state.framed.pan_x, 0, 1e-9);
}

TEST_F(OpenPainting, IsTheCommandThatItTells) {
  for (const char* mode : {"red-cyan", "left-right", "wiggle"}) {
    run(fmt::format("mode {}", mode));
    std::string line = command_line_of(viewer.session());
    Words words = words_of(line);
    ASSERT_EQ(words.front(), "wheatstone");
    words.erase(words.begin());
    words.back() = folder / words.back();
    std::ostringstream output, errors;
    EXPECT_EQ(cli::run_command_line(words, output, errors), 0) << line << '\n' << errors.str();
  }
}

TEST_F(OpenPainting, SaysWhatADamagedFileIsAndGoesOn) {
  write_whole_file(folder / "damaged.wst", "no painting");
  run_command(viewer, find_command("open"), {folder / "damaged.wst"});
  viewer.wait();
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_THAT(viewer.session().message, HasSubstr("damaged.wst"));
  run("previous-file");
  EXPECT_EQ(viewer.session().opened.kind, "painting");
}

TEST_F(OpenPainting, RefusesWhatCommandsDoNotTake) {
  const auto running = [this](const char* line) { return [this, line] { run_line(viewer, line); }; };
  expect_error(ErrorKind::wrong_usage, "'jump' is no command", running("jump"));
  expect_error(ErrorKind::wrong_usage, "pan: has 1 arguments, expected X Y", running("pan 3"));
  expect_error(ErrorKind::wrong_usage, "zoom: 'nan' is no number", running("zoom nan"));
  expect_error(ErrorKind::wrong_usage, "expected one of", running("mode teleport"));
  expect_error(ErrorKind::wrong_usage, "expected PARAMETER VALUE", running("set jitter-hue"));
  expect_error(ErrorKind::wrong_usage, "quote", running("open \"a"));
}

TEST(CommandTable, HasEachNameAndEachKeyOnce) {
  std::set<std::string_view> names;
  std::set<std::string> keys;
  for (const Command& command : command_table()) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    EXPECT_FALSE(command.text.empty());
    std::istringstream text{std::string(command.keys)};
    for (std::string key; text >> key;) {
      if (key.size() > 1 && key.ends_with(',')) key.pop_back();
      EXPECT_TRUE(keys.insert(key).second) << key;
    }
  }
}

TEST(Script, RunsItsLinesAndNamesTheOneThatFails) {
  const TemporaryFolder folder;
  write_painting(folder / "still.wst", painting());
  write_whole_file(
      folder / "tour.txt",
      fmt::format("# a tour\nopen \"{}\"\nwait\n\nmode left-right\nwait\nprint\nsave-picture \"{}\"\nfly\n",
                  (folder / "still.wst").string(), (folder / "tour.png").string()));
  Viewer viewer;
  viewer.set_viewport({300, 200});
  std::vector<std::string> printed;
  const auto run = [&] {
    run_script(viewer, folder / "tour.txt", {.print = [&](const std::string& line) { printed.push_back(line); }});
  };
  expect_error(ErrorKind::wrong_usage, "tour.txt:9: 'fly' is no command", run);
  ASSERT_EQ(printed.size(), 1u);
  EXPECT_THAT(printed.front(), HasSubstr(R"("kind":"painting","mode":"left-right")"));
  EXPECT_EQ(read_image(folder / "tour.png").width(), 300);
}

TEST(Script, EndsWhereAFileCannotBeOpened) {
  const TemporaryFolder folder;
  write_whole_file(folder / "damaged.wst", "no painting");
  write_whole_file(folder / "tour.txt", fmt::format("open \"{}\"\nwait\nprint\n", (folder / "damaged.wst").string()));
  Viewer viewer;
  expect_error(ErrorKind::bad_input, "tour.txt:2: ", [&] { run_script(viewer, folder / "tour.txt"); });
}

/// What the calling thread has worked so far.
double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

TEST(Viewer, LeavesTheWorkOnALargePaintingToItsThreads) {
  const TemporaryFolder folder;
  write_painting(folder / "large.wst", placed(painting(), {.scale = 8}));
  Viewer viewer;
  viewer.set_viewport({120, 80});
  double worst_ms = 0;
  std::string worst_line;
  const auto measure = [&](const std::string& line, const auto& work) {
    const double before_ms = thread_time_ms();
    work();
    if (const double ms = thread_time_ms() - before_ms; ms > worst_ms) {
      worst_ms = ms;
      worst_line = line;
    }
  };
  const std::string large = (folder / "large.wst").string(), missing = (folder / "missing.wst").string();
  const std::vector<std::string> lines{fmt::format("open \"{}\"", large), "zero-parallax-at 60 60",
                                       "depth-mapping reset", "comfortable", fmt::format("open \"{}\"", missing)};
  for (const std::string& line : lines) {
    measure(line, [&] { run_line(viewer, line); });
    do {
      measure(line, [&] { viewer.collect(); });
      measure(line, [&] { depth_told(viewer, 60, 60); });
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (viewer.is_busy());
  }
#ifdef __SANITIZE_ADDRESS__
  constexpr double most_ms = 40;  // checks of memory slow the work
#else
  constexpr double most_ms = 10;
#endif
  EXPECT_LE(worst_ms, most_ms) << worst_line << ": a fifth of what the window may not respond for";
}

TEST(Viewer, PaintsAPhotographAsPaintDoes) {
  const TemporaryFolder folder;
  write_image(folder / "left.png", still().pictures.left);
  write_image(folder / "right.png", still().pictures.right);
  Viewer viewer;
  viewer.session().items.push_back({folder / "left.png", folder / "right.png"});
  viewer.open(0);
  viewer.wait();
  EXPECT_THAT(viewer.session().message, IsEmpty());
  run_line(viewer, "style posterise");
  viewer.wait();
  run_command(viewer, find_command("save-painting"), {folder / "shown.wst"});
  viewer.wait();
  std::ostringstream output, errors;
  const std::vector<std::string> words{"paint", folder / "left.png", folder / "right.png", "--style", "posterise",
                                       "-o",    folder / "painted"};
  ASSERT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
  EXPECT_TRUE(read_painting(folder / "shown.wst") == read_painting(folder / "painted/painting.wst"));
}

TEST(Viewer, ComparesAPaintingWithItsPhotograph) {
  const TemporaryFolder folder;
  write_image(folder / "left.png", still().pictures.left);
  write_image(folder / "right.png", still().pictures.right);
  Viewer viewer;
  viewer.set_viewport({240, 160});
  viewer.session().items.push_back({folder / "left.png", folder / "right.png"});
  viewer.open(0);
  viewer.wait();
  const auto shown = [&](const std::string& comparison) {
    for (const std::string& line :
         {std::string("mode left"), std::string("zero-parallax 0"), "compare " + comparison}) {
      run_line(viewer, line);
      viewer.wait();
    }
    return viewer.frame()->picture;
  };
  const Image<Rgb8> painted = shown("painting"), photograph = shown("photograph"), split = shown("split");
  EXPECT_EQ(photograph, still().pictures.left);
  EXPECT_NE(painted, photograph);
  for (int y = 0; y < split.height(); ++y)
    for (int x = 0; x < split.width(); ++x)
      ASSERT_EQ(split(x, y), (x < split.width() / 2 ? photograph : painted)(x, y)) << x << ' ' << y;
  expect_error(ErrorKind::wrong_usage, "is no comparison", [&] { run_line(viewer, "compare moon"); });
}

TEST(Viewer, ShowsAPhotographAsItCameWhileItIsMadeReady) {
  const TemporaryFolder folder;
  write_image(folder / "left.png", still().pictures.left);
  write_image(folder / "right.png", still().pictures.right);
  const std::vector<std::filesystem::path> files{folder / "left.png", folder / "right.png"};
  std::vector<Opened> first;
  const auto show = [&](Opened opened) { first.push_back(std::move(opened)); };
  const Opened opened = open_content(files, {}, show);
  EXPECT_TRUE(are_eyes_of_one(files[0], files[1], show));
  ASSERT_EQ(first.size(), 2u);
  for (const Opened& shown : first) {
    EXPECT_FALSE(shown.is_ready);
    EXPECT_EQ(std::get<PaintedContent>(shown.content).photograph->pictures.right, still().pictures.right);
  }
  EXPECT_TRUE(opened.is_ready);

  // What is no pair after all is not left on the screen.
  write_image(folder / "right.png", Image<Rgb8>(240, 160, {9, 9, 9}));
  Viewer viewer;
  viewer.session().items.push_back(files);
  viewer.open(0);
  viewer.wait();
  EXPECT_THAT(viewer.session().message, HasSubstr("the right picture is blank"));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(viewer.session().opened.content));
}

TEST(Viewer, SavesBesideAllElseInOrderAndTellsWhatFails) {
  const TemporaryFolder folder;
  Viewer viewer;
  viewer.set_viewport({300, 200});
  viewer.wait();
  for (int file = 0; file < 5; ++file) run_command(viewer, find_command("save-picture"), {folder / "last.png"});
  run_command(viewer, find_command("save-picture"), {folder / "last.png" / "picture.png"});
  EXPECT_TRUE(viewer.is_saving());
  viewer.wait();
  EXPECT_EQ(read_image(folder / "last.png").width(), 300);
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_THAT(viewer.session().message, HasSubstr("picture.png"));
  ASSERT_TRUE(viewer.take_failed_save());
  EXPECT_FALSE(viewer.take_failed_save());
  write_whole_file(folder / "tour.txt",
                   fmt::format("save-picture \"{}\"\n", (folder / "last.png" / "picture.png").string()));
  expect_error(ErrorKind::cannot_read_write, "tour.txt:1: ", [&] { run_script(viewer, folder / "tour.txt"); });
}

TEST(Viewer, ShowsNothingWhereNothingIsOpen) {
  Viewer viewer;
  viewer.set_viewport({20, 10});
  viewer.wait();
  ASSERT_NE(viewer.frame(), nullptr);
  EXPECT_EQ(viewer.frame()->picture, Image<Rgb8>(20, 10));
  for (const Command& command : command_table())
    if (command.arguments.empty() && command.name != "quit" && command.name != "save-picture")
      run_command(viewer, command, {});
  viewer.wait();
}

}  // namespace wheatstone::viewer::viewer_test
