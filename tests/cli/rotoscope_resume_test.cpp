// `wheatstone rotoscope` that is killed or stopped, and goes on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::rotoscope_resume_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr int frame_count = 20;
constexpr int interval = 4;

/// A folder with a film of two eyes, in which the command is run.
class Workplace {
 public:
  Workplace() {
    FilmWriter writer(folder_ / "source.mp4", {.preset = "ultrafast", .layout = StereoLayout::left_right});
    for (int i = 0; i < frame_count; ++i) {
      const Image<Rgb8> left = moving_picture(80, 48, i), right = moving_picture(80, 48, i, 4);
      writer.write({put_together(left, right, StereoLayout::left_right), i, {1, 25}, 1});
    }
    writer.finish();
  }

  const TemporaryFolder& folder() const { return folder_; }
  fs::path operator/(const std::string& name) const { return folder_ / name; }

  /// The words of a run that keeps marks, too, by which its progress is seen.
  static Words line(const std::string& output, const Words& more = {}) {
    Words words{"rotoscope", "source.mp4", "-o",           output,
                "--quiet",   "--json",     "--checkpoint", std::to_string(interval),
                "--preset",  "ultrafast",  "--save-marks", output + "_%04d.wst"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  ProgramResult run(const std::string& output, const Words& more = {}) const {
    return run_program(line(output, more), {.folder = folder_ / ""});
  }

  /// Sends a signal when the marks of `frame` (from 1) are there, and a frame later.
  ProgramResult run_until(const std::string& output, int frame, int signal, std::chrono::milliseconds later = {},
                          const Words& more = {}) const {
    return run_program(line(output, more), {.folder = folder_ / "", .while_running = [&](int process) {
                                              wait_for(marks(output, frame));
                                              std::this_thread::sleep_for(later);
                                              ::kill(process, signal);
                                            }});
  }

  int frames_with_marks(const std::string& output) const {
    int count = 0;
    while (fs::exists(marks(output, count + 1))) ++count;
    return count;
  }

 private:
  fs::path marks(const std::string& output, int frame) const {
    std::string number = std::to_string(frame);
    number.insert(0, 4 - number.size(), '0');
    return folder_ / (output + "_%04d.wst.part") / (output + "_" + number + ".wst");
  }

  static void wait_for(const fs::path& file) {
    for (int tries = 0; tries < 6000 && !fs::exists(file); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  TemporaryFolder folder_;
};

/// The film that a run without a break paints.
const std::string& undisturbed_bytes() {
  static const std::string bytes = [] {
    const Workplace work;
    EXPECT_EQ(work.run("whole.mp4").exit_code, 0);
    return bytes_of(work / "whole.mp4");
  }();
  return bytes;
}

TEST(RotoscopeResumeLong, KilledAtAnyMomentTheFilmIsTheSame) {
  const Workplace work;
  ASSERT_EQ(work.run("whole.mp4").exit_code, 0);
  const std::vector<Frame> undisturbed = frames_of(work / "whole.mp4");
  ASSERT_EQ(undisturbed.size(), static_cast<std::size_t>(frame_count));
  std::mt19937 random(20150607);
  for (int time = 0; time < 5; ++time) {
    // Any frame but the last, and any frame of the one after.
    const int frame = std::uniform_int_distribution(1, frame_count - 2)(random);
    const std::chrono::milliseconds later(std::uniform_int_distribution(0, 40)(random));
    const std::string name = "killed_" + std::to_string(time) + ".mp4";
    SCOPED_TRACE(name + ": frame " + std::to_string(frame));
    EXPECT_EQ(work.run_until(name, frame, SIGKILL, later).exit_code, 128 + SIGKILL);
    const int painted = work.frames_with_marks(name);
    EXPECT_GE(painted, frame);
    EXPECT_FALSE(fs::exists(work / name));

    expect_refused(work.folder(), Workplace::line(name), 2,
                   "did not finish, and must be deleted to start again; use --resume to continue that run");
    const ProgramResult resumed = work.run(name, {"--resume"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
    const auto facts = nlohmann::json::parse(resumed.output);
    EXPECT_EQ(facts["frames"], frame_count);
    EXPECT_LE(painted - facts["resumed_frames"].get<int>(), interval) << "more than one interval was repeated";
    EXPECT_TRUE(bytes_of(work / name) == bytes_of(work / "whole.mp4"));
    const std::vector<Frame> frames = frames_of(work / name);
    ASSERT_EQ(frames.size(), undisturbed.size());
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_TRUE(frames[i].picture == undisturbed[i].picture) << i;
    EXPECT_FALSE(fs::exists(work / (name + ".part")));
    for (const std::string end : {"_0001.wst", "_0011.wst", "_0020.wst"})
      EXPECT_TRUE(bytes_of(work / (name + end)) == bytes_of(work / ("whole.mp4" + end))) << end;
  }
}

TEST(RotoscopeResumeLong, KilledAgainAndAgainTheFilmIsTheSame) {
  const Workplace work;
  const ProgramResult whole = work.run("whole.mp4");
  ASSERT_EQ(whole.exit_code, 0);
  for (const int frame : {6, 9, 14, 17})
    EXPECT_EQ(work.run_until("a.mp4", frame, SIGKILL, {}, {"--resume"}).exit_code, 128 + SIGKILL);
  const ProgramResult resumed = work.run("a.mp4", {"--resume", "--threads", "1"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_TRUE(bytes_of(work / "a.mp4") == bytes_of(work / "whole.mp4"));
  const auto is = nlohmann::json::parse(resumed.output), was = nlohmann::json::parse(whole.output);
  EXPECT_GE(is["resumed_frames"], 16);
  for (const char* sum : {"frames", "scenes", "strokes_a_frame", "survival", "popped_strokes", "worst_bare_share"})
    EXPECT_EQ(is[sum], was[sum]) << sum;
}

TEST(RotoscopeResume, InterruptedItSaysHowToGoOn) {
  const Workplace work;
  const ProgramResult stopped = work.run_until("a.mp4", 9, SIGINT);
  EXPECT_EQ(stopped.exit_code, 5);
  EXPECT_THAT(stopped.errors,
              testing::MatchesRegex("wheatstone: interrupted; the first (8|12|16) frames are kept in a.mp4.part and "
                                    "a.mp4_%04d.wst.part; use --resume to continue that run\n"));
  EXPECT_FALSE(fs::exists(work / "a.mp4"));
  EXPECT_EQ(work.run("a.mp4", {"--resume"}).exit_code, 0);
  EXPECT_TRUE(bytes_of(work / "a.mp4") == undisturbed_bytes());
}

TEST(RotoscopeResume, InterruptedBeforeTheFirstCheckpointItLeavesNothing) {
  const Workplace work;
  const ProgramResult stopped =
      run_program({"rotoscope", "source.mp4", "-o", "a.mp4", "--quiet", "--save-marks", "m_%04d.wst"},
                  {.folder = work / "", .while_running = [&](int process) {
                     while (!fs::exists(work / "m_%04d.wst.part/m_0002.wst"))
                       std::this_thread::sleep_for(std::chrono::milliseconds(5));
                     ::kill(process, SIGINT);
                   }});
  EXPECT_EQ(stopped.exit_code, 5);
  EXPECT_EQ(stopped.errors, "wheatstone: interrupted; nothing half-written is left\n");
  EXPECT_EQ(files_in(work / ""), std::set<std::string>{"source.mp4"});
}

TEST(RotoscopeResume, OtherOptionsOrAnotherSourceAreRefused) {
  const Workplace work;
  EXPECT_EQ(work.run_until("a.mp4", 6, SIGKILL).exit_code, 128 + SIGKILL);
  const auto refused = [&](const Words& more) {
    Words line = Workplace::line("a.mp4", {"--resume"});
    line.insert(line.end(), more.begin(), more.end());
    expect_refused(work.folder(), line, 2, "left by a run with other options or sources");
  };
  refused({"--style", "pointillist"});
  refused({"--seed", "9"});
  refused({"--crf", "30"});
  refused({"--layout", "right-left", "--output-layout", "left-right"});
  refused({"--from", "0.1"});
  EXPECT_EQ(work.run("a.mp4", {"--resume"}).exit_code, 0);
}

TEST(RotoscopeResume, AFullDiskKeepsWhatIsDone) {
  const Workplace work;
  EXPECT_EQ(work.run_until("a.mp4", 10, SIGKILL).exit_code, 128 + SIGKILL);
  const ProgramResult full =
      run_program({"rotoscope", "source.mp4", "-o", "a.mp4", "--quiet", "--checkpoint", std::to_string(interval),
                   "--preset", "ultrafast", "--resume", "--save-marks", "a.mp4_%04d.wst"},
                  {.folder = work / "", .largest_file = 2000});
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_THAT(full.errors, testing::MatchesRegex("wheatstone: [^\n]*File too large\n"));
  EXPECT_FALSE(fs::exists(work / "a.mp4"));
  const ProgramResult resumed = work.run("a.mp4", {"--resume"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.errors;
  EXPECT_GE(nlohmann::json::parse(resumed.output)["resumed_frames"], 8);
  EXPECT_TRUE(bytes_of(work / "a.mp4") == undisturbed_bytes());
}

TEST(RotoscopeResume, WithoutRoomForACheckpointThereIsNothingToGoOnWith) {
  const Workplace work;
  const ProgramResult full =
      run_program({"rotoscope", "source.mp4", "-o", "a.mp4", "--quiet", "--checkpoint", std::to_string(interval)},
                  {.folder = work / "", .largest_file = 2000});
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_THAT(full.errors, testing::MatchesRegex("wheatstone: [^\n]*File too large\n"));
  EXPECT_EQ(files_in(work / ""), std::set<std::string>{"source.mp4"});
}

}  // namespace wheatstone::rotoscope_resume_test
