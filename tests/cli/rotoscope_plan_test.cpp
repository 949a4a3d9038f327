// `wheatstone rotoscope --plan`, `--draw` and `--join`: a film that many processes make.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::rotoscope_plan_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr int frame_count = 18;

/// A film of two eyes with sound and a timecode.
void make_source(const TemporaryFolder& folder) {
  FilmWriter writer(folder / "pictures.mp4", {.preset = "ultrafast", .layout = StereoLayout::left_right});
  for (int i = 0; i < frame_count; ++i) {
    const Image<Rgb8> left = moving_picture(80, 48, i), right = moving_picture(80, 48, i, 4);
    writer.write({put_together(left, right, StereoLayout::left_right), i, {1, 25}, 1});
  }
  writer.finish();
  ffmpeg("-i " + (folder / "pictures.mp4").string() +
         " -f lavfi -i sine=d=0.72 -timecode 01:02:03:04 -c:v copy -c:a aac " + (folder / "source.mp4").string());
}

TEST(RotoscopePlan, FourPartsOfFourProcessesAreTheFilmOfOneByteForByte) {
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  const TemporaryFolder folder;
  make_source(folder);
  const ProgramRun place{.folder = folder / ""}, own{.folder = folder / "", .own_process = true};
  const Words usual{"rotoscope", "source.mp4",   "--layout", "sbs",   "--preset",
                    "ultrafast", "--checkpoint", "4",        "--json"};
  const auto with = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(run_program(with(usual, {"-o", "whole.mp4"}), place).exit_code, 0);
  const ProgramResult planned = run_program(with(usual, {"-o", "joined.mp4", "--plan", "a.plan"}), place);
  ASSERT_EQ(planned.exit_code, 0) << planned.errors;
  EXPECT_GT(nlohmann::json::parse(planned.output).at("plan_megabytes_a_frame").get<double>(), 0);
  EXPECT_FALSE(fs::exists(folder / "joined.mp4"));
  // Marks of a plan are paintings as any.
  EXPECT_EQ(run_program({"info", "a.plan/marks_000018.wst"}, place).exit_code, 0);
  std::vector<std::thread> processes;
  std::vector<ProgramResult> drawn(4);
  for (std::size_t i = 0; i < 4; ++i)
    processes.emplace_back([&, i] {
      drawn[i] =
          run_program({"rotoscope", "--draw", "a.plan", "--frame-range", std::to_string(i + 1) + "/4", "--json"}, own);
    });
  for (std::thread& process : processes) process.join();
  int frames = 0;
  for (const ProgramResult& one : drawn) {
    ASSERT_EQ(one.exit_code, 0) << one.errors;
    frames += nlohmann::json::parse(one.output).at("frames").get<int>();
  }
  EXPECT_EQ(frames, frame_count);
  const ProgramResult joined = run_program({"rotoscope", "--join", "a.plan"}, place);
  ASSERT_EQ(joined.exit_code, 0) << joined.errors;
  EXPECT_TRUE(bytes_of(folder / "joined.mp4") == bytes_of(folder / "whole.mp4"));
  ASSERT_EQ(run_program({"rotoscope", "--join", "a.plan", "-o", "again.mp4"}, place).exit_code, 0);
  EXPECT_TRUE(bytes_of(folder / "again.mp4") == bytes_of(folder / "whole.mp4"));
}

TEST(RotoscopePlan, BadInputIsNamedInOneLine) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 6, {.preset = "ultrafast"});
  const auto refused = [&](const Words& words, int exit_code, const std::string& part) {
    Words line{"rotoscope", "--quiet"};
    line.insert(line.end(), words.begin(), words.end());
    expect_refused(folder, line, exit_code, part);
  };
  const Words plan{"rotoscope", "a.mp4",  "--layout", "mono", "--checkpoint", "2",
                   "--quiet",   "--plan", "a.plan",   "-o",   "o.mp4"};
  ASSERT_EQ(run_program(plan, {.folder = folder / ""}).exit_code, 0);
  refused({"a.mp4", "--layout", "mono", "--plan", "a.plan"}, 2, "a.plan: exists already, expected no such file");
  refused({"a.mp4", "--plan", "b.plan", "-o", "o_%04d.wst"}, 2, "--plan: has no effect on marks (.wst)");
  refused({"a.mp4", "--plan", "b.plan", "--resume"}, 2, "--plan: has no effect with --resume");
  refused({"a.mp4", "--layout", "mono", "--plan", "b.plan", "-o", "o.mp4", "--codec", "prores-hq"}, 2, "o.mp4: ");
  refused({"a.mp4", "--draw"}, 3, "a.mp4: is no plan of a film, expected a folder that --plan made");
  refused({"--draw", "a.plan", "--style", "mosaic"}, 2, "--style: has no effect with --draw; the plan says it");
  refused({"--draw", "a.plan", "--frame-range", "5-7"}, 2, "a.plan: has the frames 1 to 6, not 5 to 7");
  refused({"--draw", "a.plan", "--frame-range", "half"}, 2, "--frame-range: is 'half', expected frames as 1-48, or a");
  refused({"--draw", "a.plan", "--frame-range", "3/2"}, 2, "--frame-range: is '3'");
  refused({"--join", "a.plan"}, 3, "a.plan: frames 1 to 6 are not drawn, expected all 6");
  ASSERT_EQ(run_program({"rotoscope", "--draw", "a.plan", "--frame-range", "3-4"}, {.folder = folder / ""}).exit_code,
            0);
  refused({"--join", "a.plan"}, 3, "a.plan: frames 1 to 2 are not drawn, expected all 6; draw them with --draw");
  std::string description = bytes_of(folder / "a.plan/plan");
  description[20] = static_cast<char>(description[20] ^ 1);
  put_bytes(folder / "a.plan/plan", description);
  refused({"--join", "a.plan"}, 3, "a.plan: is damaged, plan the film again");
}

}  // namespace wheatstone::rotoscope_plan_test
