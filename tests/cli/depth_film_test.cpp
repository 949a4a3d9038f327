// Films of one eye and their depth on the command line: what is made, and what is refused in one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "scenes/tiny_network.h"

namespace wheatstone::depth_film_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Grey columns that wander, near on the right; `flat`: one grey.
void make_depth(const fs::path& path, int frames, int width = 64, int height = 48, bool flat = false) {
  FilmWriter writer(path, {.preset = "ultrafast"});
  for (int i = 0; i < frames; ++i) {
    Image<Rgb8> picture(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto level = static_cast<std::uint8_t>(flat ? 90 : 40 + 3 * ((x + i) / 16 * 16));
        picture(x, y) = {level, level, level};
      }
    writer.write({std::move(picture), i, {1, 25}, 1});
  }
  writer.finish();
}

Words rotoscope_line(const Words& words) {
  Words line{"rotoscope", "walk.mp4", "--preset", "ultrafast", "--quiet"};
  line.insert(line.end(), words.begin(), words.end());
  return line;
}

nlohmann::json painted(const TemporaryFolder& folder, const Words& words) {
  Words line = rotoscope_line(words);
  line.emplace_back("--json");
  const ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  return nlohmann::json::parse(result.output, nullptr, false);
}

TEST(DepthFilm, MakesTwoEyesOfOneAndViewsForADisplay) {
  const TemporaryFolder folder;
  make_film(folder / "walk.mp4", 3, {.preset = "ultrafast"});
  make_depth(folder / "depth.mp4", 3);
  EXPECT_EQ(painted(folder, {"--depth", "depth.mp4", "--strength", "8%", "-o", "o.mp4"})["frames"], 3);
  const std::vector<Frame> frames = frames_of(folder / "o.mp4");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames.front().picture.width(), 128);
  const nlohmann::json facts = painted(
      folder, {"--depth", "depth.mp4", "--display", "looking-glass-portrait", "--size", "21x28", "-o", "quilt"});
  EXPECT_EQ(facts["output"], "quilt_qs8x6a0.75.mp4");
}

TEST(DepthFilm, ANetworkFindsTheDepthOfEachFrame) {
  const TemporaryFolder folder;
  make_film(folder / "walk.mp4", 3, {.preset = "ultrafast"});
  put_bytes(folder / "red.onnx", tiny_network::red_of_one_picture(48, 32));
  EXPECT_EQ(painted(folder, {"--depth-model", "red.onnx", "-o", "o.mp4"})["frames"], 3);
  EXPECT_EQ(frames_of(folder / "o.mp4").front().picture.width(), 128);
  put_bytes(folder / "text.onnx", "no network");
  expect_refused(folder, rotoscope_line({"--depth-model", "text.onnx"}), 3, "text.onnx: is not an ONNX network");
  expect_refused(folder, rotoscope_line({"--depth-model", "red.onnx", "--depth-is", "metric"}), 2, "--depth-is");
}

TEST(DepthFilm, AnotherNetworkMayFindTheFlow) {
  const TemporaryFolder folder;
  make_film(folder / "walk.mp4", 3, {.preset = "ultrafast"});
  put_bytes(folder / "flow.onnx", tiny_network::no_flow_of_two_pictures(64, 32));
  EXPECT_EQ(painted(folder, {"--flow", "onnx", "--flow-model", "flow.onnx", "-o", "o.mp4"})["frames"], 3);
  put_bytes(folder / "red.onnx", tiny_network::red_of_one_picture(48, 32));
  expect_refused(folder, rotoscope_line({"--flow", "onnx", "--flow-model", "red.onnx"}), 3,
                 "red.onnx: input 'image' is not 1x6xHEIGHTxWIDTH");
  expect_refused(folder, rotoscope_line({"--flow", "onnx"}), 2, "--flow-model FILE.onnx");
}

TEST(DepthFilm, DepthThatDoesNotFitTheFilmIsRefused) {
  const TemporaryFolder folder;
  make_film(folder / "walk.mp4", 4, {.preset = "ultrafast"});
  make_depth(folder / "short.mp4", 3);
  make_depth(folder / "long.mp4", 5);
  make_depth(folder / "broad.mp4", 4, 96, 48);
  make_depth(folder / "flat.mp4", 4, 64, 48, true);
  const auto refused = [&](const Words& words, int exit_code, const std::string& part) {
    expect_refused(folder, rotoscope_line(words), exit_code, part);
  };
  refused({"--depth", "short.mp4"}, 3, "short.mp4: has 3 frames, expected 4 as walk.mp4");
  refused({"--depth", "long.mp4"}, 3, "long.mp4: has 5 frames, expected 4 as walk.mp4");
  refused({"--depth", "broad.mp4"}, 3, "broad.mp4: is 96x48 pixels, expected the shape of walk.mp4, 64x48");
  refused({"--depth", "flat.mp4"}, 3, "flat.mp4: its depth is the same everywhere");
  refused({"--depth", "walk.mp4"}, 3, "walk.mp4: is in colour, expected grey for depth");
  refused({"--depth", "none.mp4"}, 3, "none.mp4: no such file");
  refused({"--depth", "short.mp4", "--layout", "sbs"}, 2, "--depth: belongs to a film of one eye");
  refused({"--depth", "short.mp4", "--rectify", "never"}, 2, "--rectify: has no effect with --depth");
  refused({"--depth", "short.mp4", "-o", "short.mp4"}, 2, "short.mp4");
  refused({"--strength", "5%"}, 2, "--strength: has no effect without --depth");
}

}  // namespace wheatstone::depth_film_test
