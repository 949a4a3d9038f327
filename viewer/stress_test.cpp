// Random commands, which nobody would give one after the other: nothing may crash, hang or leave a state that nothing
// can be drawn from.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "command_table.h"
#include "output_mode.h"
#include "script.h"
#include "temporary_folder.h"
#include "viewer.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::stress_test {

using Random = std::mt19937_64;

std::size_t any(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

template <typename Range>
std::string one_of(Random& random, const Range& range) {
  return std::string(range[any(random, std::size(range))]);
}

/// A painting, a photograph, slices, particles, a model, and a file that is none of them.
std::vector<std::string> small_files(const TemporaryFolder& folder) {
  const SyntheticStill still = make_synthetic_still({.width = 96, .height = 64, .samples_a_side = 1});
  write_painting(folder / "painting.wst", plan_painting(still.pictures, still.geometry, {}));
  write_image(folder / "left.png", still.pictures.left);
  write_image(folder / "right.png", still.pictures.right);
  SliceStack stack{.width = 64, .height = 48};
  for (const float parallax_px : {-3.f, 1.f, 4.f})
    stack.slices.push_back({.parallax_px = parallax_px, .pixels = Image<LinearRgba>(64, 48, {0.2f, 0.3f, 0.1f, 0.4f})});
  write_slices(folder / "slices.exr", stack);
  std::string table = "x y z\n";
  Random random(1);
  std::normal_distribution<double> place(0, 1);
  for (int particle = 0; particle < 300; ++particle)
    table += fmt::format("{:.4f} {:.4f} {:.4f}\n", place(random), place(random), place(random));
  write_whole_file(folder / "particles.txt", table);
  write_whole_file(folder / "model.obj", "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  write_whole_file(folder / "damaged.wst", "no painting");
  std::vector<std::string> names;
  write_jps(folder / "pair.jps", still.pictures.left, still.pictures.right);
  for (const char* name : {"painting.wst", "slices.exr", "particles.txt", "model.obj", "damaged.wst", "missing.wst",
                           "left.png", "pair.jps"})
    names.push_back(folder / name);
  return names;
}

/// Makes up commands: mostly such as somebody might give.
class Monkey {
 public:
  Monkey(std::vector<std::string> files, std::filesystem::path folder, std::uint64_t seed)
      : files_(std::move(files)), folder_(std::move(folder)), random_(seed) {}

  std::string line() {
    const auto commands = command_table();
    std::string_view name;
    const Command* command = nullptr;
    do {
      command = &commands[any(random_, commands.size())];
      name = command->name;
    } while (name == "quit" || name == "leave" || name == "head-tracker" || name == "open-example");
    return line_of(*command);
  }
  std::string line_of(const Command& command) {
    const std::string_view name = command.name;
    std::string line(name);
    // What writes files is to write them into the folder of the test.
    const bool may_write = command.arguments.find("FILE") != std::string_view::npos && name != "open";
    if (!may_write && any(random_, 20) == 0) return line + nonsense();
    for (const std::string& word : words_of(command.arguments)) {
      if (word.starts_with('[') && any(random_, 2) == 0) continue;
      line += " \"" + argument(name, word) + '"';
    }
    return line;
  }
  Random& random() { return random_; }

 private:
  std::string nonsense() {
    static constexpr std::array words{"",    " -1", " nan",      " 1e308", " a b c d e f g",
                                      " \"", " 0",  " \xff\xfe", " ../.."};
    return one_of(random_, words);
  }
  std::string number() {
    static constexpr std::array extremes{"0", "-1", "1e9", "-1e30", "inf", "1e-30", "0x10", "three"};
    if (any(random_, 12) == 0) return one_of(random_, extremes);
    return fmt::format("{:.3f}", std::normal_distribution<double>(0, any(random_, 2) == 0 ? 2 : 60)(random_));
  }
  std::string argument(std::string_view command, const std::string& word) {
    if (command == "mode") return std::string(output_modes()[any(random_, output_modes().size())].name);
    if (command == "look-with") return std::string(devices()[any(random_, devices().size())].name);
    if (command == "display") return std::string(display_presets()[any(random_, display_presets().size())].name);
    if (command == "style") return any(random_, 9) == 0 ? "nothing" : one_of(random_, style_names());
    if (command == "set" && word == "PARAMETER")
      return std::string(style_parameters()[any(random_, style_parameters().size())].name);
    if (command == "open") return files_[any(random_, files_.size())];
    if (word.find("FILE") != std::string::npos) return (folder_ / "saved.png").string();
    if (word.find('|') != std::string::npos) return choice(word);
    if (command == "resize") return std::to_string(1 + any(random_, 200));
    return number();
  }
  std::string choice(const std::string& words) {
    std::vector<std::string> choices(1);
    for (const char letter : words) {
      if (letter == '|') {
        choices.emplace_back();
      } else {
        choices.back() += letter;
      }
    }
    return one_of(random_, choices);
  }

  std::vector<std::string> files_;
  std::filesystem::path folder_;
  Random random_;
};

void expect_consistent(const Session& session) {
  const ViewState& state = session.state;
  EXPECT_NO_THROW(find_output_mode(state.mode));
  EXPECT_NO_THROW(find_display(state.display));
  for (const double value : {static_cast<double>(state.head), static_cast<double>(state.adjustment.zero_parallax_px),
                             static_cast<double>(state.adjustment.separation), state.framed.zoom, state.framed.pan_x,
                             state.framed.pan_y, static_cast<double>(state.orbit.zoom)})
    EXPECT_TRUE(std::isfinite(value));
  EXPECT_GE(state.adjustment.separation, 0);
  EXPECT_GE(state.slicing.finest_layer, 0);
  EXPECT_LE(session.done.size(), 200u);
  EXPECT_TRUE(session.items.empty() || session.item < session.items.size());
}

/// Waits until nothing is busy; false after a minute.
bool settles(Viewer& viewer) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  for (viewer.collect(); viewer.is_busy(); viewer.collect()) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(1000);
  }
  return true;
}

void run_random_commands(int count, std::uint64_t seed) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = small_files(folder);
  Monkey monkey(files, folder / "", seed);
  Viewer viewer;
  viewer.set_viewport({120, 80});
  viewer.open_all({files[0]});
  for (int step = 0; step < count; ++step) {
    const std::string line = monkey.line();
    SCOPED_TRACE(fmt::format("seed {}, step {}: {}", seed, step, line));
    try {
      run_line(viewer, line);
    } catch (const Error&) {  // it was implausible
    }
    viewer.collect();
    if (any(monkey.random(), 40) == 0)
      viewer.set_viewport({static_cast<int>(1 + any(monkey.random(), 150)),
                           static_cast<int>(1 + any(monkey.random(), 100)), static_cast<int>(any(monkey.random(), 50)),
                           7});
    if (any(monkey.random(), 10) != 0) continue;
    ASSERT_TRUE(settles(viewer));
    expect_consistent(viewer.session());
    if (testing::Test::HasFailure()) return;
  }
  run_line(viewer, "mode left");
  run_line(viewer, "fit");
  viewer.set_viewport({120, 80});
  viewer.session().items.push_back({files[0]});
  viewer.open(viewer.session().items.size() - 1);
  ASSERT_TRUE(settles(viewer));
  EXPECT_EQ(viewer.session().opened.kind, "painting");
  EXPECT_EQ(viewer.frame()->picture.width(), 120);
}

/// Megabytes that this process has in memory.
double resident_mb() {
  malloc_trim(0);
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST(RandomCommands, LeaveAStateThatCanBeDrawn) { run_random_commands(300, 1); }

TEST(RandomTouches, LeaveAPhotographThatCanBePainted) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = small_files(folder);
  Viewer viewer;
  viewer.set_viewport({120, 80});
  viewer.open_all({files.back()});
  ASSERT_TRUE(settles(viewer));
  run_line(viewer, "style oil");
  Monkey monkey(files, folder / "", 5);
  static constexpr std::array commands{"retouch",  "brush-radius", "brush-strength", "touch", "touch", "touch",
                                       "touch-on", "touch-on",     "undo",           "redo",  "style"};
  for (int step = 0; step < 200; ++step) {
    const std::string line = monkey.line_of(find_command(one_of(monkey.random(), commands)));
    SCOPED_TRACE(line);
    try {
      run_line(viewer, line);
    } catch (const Error&) {  // it was implausible
    }
    if (any(monkey.random(), 4) != 0) continue;
    ASSERT_TRUE(settles(viewer));
    EXPECT_FALSE(viewer.session().message_is_error) << viewer.session().message;
    EXPECT_TRUE(std::ranges::all_of(
        std::get<PaintedContent>(viewer.session().opened.content).photograph->geometry->left_disparity.pixels(),
        [](float d) { return std::isfinite(d); }));
  }
  EXPECT_FALSE(viewer.session().state.touches.empty());
}

TEST(RandomCommandsLong, LeaveAStateThatCanBeDrawn) {
  for (std::uint64_t seed = 2; seed < 22; ++seed) run_random_commands(500, seed);
}

TEST(MemoryLong, StaysFlatOverAThousandChanges) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = small_files(folder);
  Viewer viewer;
  viewer.set_viewport({320, 240});
  viewer.open_files({files[0]});
  viewer.session().walk = {{files[0]}, {files[1]}, {files[2]}, {folder / "left.png", folder / "right.png"}};
  viewer.session().walk_is_given = true;
  const std::array lines{
      "head 0.4",    "mode left-right",     "zoom 3",         "pan 10 3", "next-file",   "zero-parallax 3",
      "mode wiggle", "mode red-cyan",       "style mosaic",   "fit",      "orbit 10 3",  "head -0.2",
      "swap",        "style impressionist", "finest-layer 0", "undo",     "less-detail", "next-file"};
  double before_mb = 0;
  for (int change = 0; change < 1200; ++change) {
    run_line(viewer, lines[static_cast<std::size_t>(change) % lines.size()]);
    ASSERT_TRUE(settles(viewer));
    if (change == 200) before_mb = resident_mb();
  }
  const double after_mb = resident_mb();
  RecordProperty("before_mb", std::to_string(before_mb));
  RecordProperty("after_mb", std::to_string(after_mb));
  EXPECT_LT(after_mb, before_mb + 12);
}

TEST(Files, MayVanishOrChangeWhileTheyAreOpen) {
  const TemporaryFolder folder;
  const std::vector<std::string> files = small_files(folder);
  Viewer viewer;
  viewer.set_viewport({120, 80});
  viewer.open_all({files[0], files[1]});
  ASSERT_TRUE(settles(viewer));
  ASSERT_EQ(viewer.session().opened.kind, "painting");

  std::filesystem::remove(files[0]);
  run_line(viewer, "head 0.5");
  ASSERT_TRUE(settles(viewer));
  EXPECT_FALSE(viewer.session().message_is_error) << "what is open needs its file no longer";
  run_line(viewer, "next-file");
  ASSERT_TRUE(settles(viewer));
  EXPECT_EQ(viewer.session().opened.kind, "slices");
  run_line(viewer, "previous-file");
  ASSERT_TRUE(settles(viewer));
  EXPECT_TRUE(viewer.session().message_is_error);
  EXPECT_NE(viewer.session().message.find("painting.wst"), std::string::npos);

  const std::string whole = read_whole_file(files[1], 1 << 24);
  for (const std::size_t left : {whole.size() / 2, std::size_t{100}, std::size_t{0}}) {
    write_whole_file(files[1], whole.substr(0, left));
    viewer.tell("");
    run_line(viewer, "next-file");
    ASSERT_TRUE(settles(viewer));
    EXPECT_TRUE(viewer.session().message_is_error) << left << " bytes are left";
    run_line(viewer, "previous-file");
    ASSERT_TRUE(settles(viewer));
  }
  write_whole_file(files[1], whole);
  run_line(viewer, "next-file");
  ASSERT_TRUE(settles(viewer));
  EXPECT_EQ(viewer.session().opened.kind, "slices") << "a file that is whole again is opened again";
}

}  // namespace wheatstone::viewer::stress_test
