#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::measure_film_test {

using testing::HasSubstr;

ProgramResult run_in(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  ProgramResult result = run_program(arguments, {.folder = folder / "."});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result;
}

void make_film(const TemporaryFolder& folder, const std::string& name, const std::string& noise) {
  run_in(folder, {"synth", "film", "-o", name, "--size", "160x96", "--frames", "5", "--cut", "2", "--samples", "2",
                  "--noise", noise, "--quiet"});
}

TEST(MeasureFilmCommand, NoiseComesOutWorseThanTheSource) {
  const TemporaryFolder folder;
  make_film(folder, "film", "0");
  make_film(folder, "noisy", "10");
  const auto facts = nlohmann::json::parse(
      run_in(folder, {"measure", "film", "noisy", "film", "--against", "film", "--truth", "film", "--json"}).output);
  EXPECT_EQ(facts["frames"], 5);
  EXPECT_EQ(facts["cuts"], nlohmann::json::array({2}));
  EXPECT_EQ(facts["flow"], "true");
  const auto &source = facts["source"], &noisy = facts["films"][0];
  EXPECT_EQ(facts["films"][1]["temporal_error"], source["temporal_error"]);
  EXPECT_EQ(source["pairs"], 3);
  EXPECT_EQ(source["pair"].size(), 4u);
  EXPECT_EQ(source["pair"][1]["cut"], true);
  const double sigma_square = 10.0 * 10 / (255.0 * 255);
  const double added = noisy["temporal_error"].get<double>() - source["temporal_error"].get<double>();
  EXPECT_GT(added, 1.1 * sigma_square);
  EXPECT_LT(added, 2 * sigma_square);
  EXPECT_EQ(noisy["stereo_frames"], 5);
  EXPECT_EQ(noisy["stereo_a_frame"].size(), 5u);
  EXPECT_GT(noisy["stereo"]["left_right_mean_absolute"], source["stereo"]["left_right_mean_absolute"]);
}

TEST(MeasureFilmCommand, FindsFlowAndCutsItself) {
  const TemporaryFolder folder;
  make_film(folder, "film", "0");
  make_film(folder, "noisy", "10");
  const std::vector<std::string> line{"measure", "film", "noisy/left_%04d.png", "--against", "film/left_%04d.png"};
  const ProgramResult table = run_in(folder, line);
  EXPECT_THAT(table.output, HasSubstr("cuts before frame 2"));
  EXPECT_THAT(table.output, HasSubstr("noisy/left_%04d.png"));
  std::vector<std::string> as_json = line;
  as_json.insert(as_json.end(), {"--json", "--frames", "2"});
  const auto facts = nlohmann::json::parse(run_in(folder, as_json).output);
  EXPECT_EQ(facts["frames"], 2);
  EXPECT_EQ(facts["flow"], "estimated");
  EXPECT_GT(facts["films"][0]["temporal_error"], facts["source"]["temporal_error"]);
  EXPECT_FALSE(facts["source"].contains("stereo"));
  // An eye each is the folder's two eyes.
  const auto eyes = nlohmann::json::parse(run_in(folder, {"measure", "film", "film/left_%04d.png,film/right_%04d.png",
                                                          "--against", "film", "--json", "--stereo-frame-step", "3"})
                                              .output);
  EXPECT_EQ(eyes["films"][0]["stereo"], eyes["source"]["stereo"]);
  EXPECT_EQ(eyes["source"]["stereo_frames"], 2);
}

TEST(MeasureFilmCommand, CountsWrongPixelsOfTheMeanAndTheWorstFrame) {
  const TemporaryFolder folder;
  for (const char* name : {"source", "painted"}) std::filesystem::create_directories(folder / name);
  for (int i = 0; i < 4; ++i) {
    Image<Rgb8> picture(64, 40, {100, 100, 100});
    const std::string file = "/f_" + std::to_string(i) + ".png";
    write_image(folder / ("source" + file), picture);
    if (i == 2)
      for (int y = 0; y < 16; ++y) std::fill_n(&picture(8, y), 16, Rgb8{250, 100, 100});
    write_image(folder / ("painted" + file), picture);
  }
  const std::vector<std::string> line{"measure", "film", "painted", "source", "--against", "source"};
  const ProgramResult table = run_in(folder, line);
  EXPECT_THAT(table.output, testing::ContainsRegex("painted .* 2\\.50 % +10\\.00 %"));
  std::vector<std::string> as_json = line;
  as_json.emplace_back("--json");
  const auto facts = nlohmann::json::parse(run_in(folder, as_json).output);
  const auto& wrong = facts["films"][0]["wrong"];
  EXPECT_DOUBLE_EQ(wrong["mean_share"], 0.025);
  EXPECT_DOUBLE_EQ(wrong["worst_share"], 0.1);
  EXPECT_EQ(wrong["worst_frame"], 2);
  EXPECT_EQ(wrong["frame"].size(), 4u);
  EXPECT_EQ(facts["films"][1]["wrong"]["worst_share"], 0);
  EXPECT_FALSE(facts["source"].contains("wrong"));
}

TEST(MeasureFilmCommand, ComparesWhatOverlapsAndSaysSo) {
  const TemporaryFolder folder;
  wheatstone::make_film(folder / "a.mkv", 5, {.codec = "ffv1"});
  wheatstone::make_film(folder / "short.mkv", 3, {.codec = "ffv1"});
  const ProgramResult text = run_in(folder, {"measure", "film", "short.mkv", "--against", "a.mkv", "--layout", "mono"});
  EXPECT_THAT(text.output, testing::HasSubstr("only the first 3 frames are compared: short.mkv ends there\n"));
  const auto facts = nlohmann::json::parse(
      run_in(folder, {"measure", "film", "short.mkv", "--against", "a.mkv", "--layout", "mono", "--json"}).output);
  EXPECT_EQ(facts["frames"], 3);
  EXPECT_EQ(facts["shorter"], nlohmann::json({"short.mkv"}));
  EXPECT_EQ(facts["films"][0]["temporal_error"], facts["source"]["temporal_error"]);
  // The source may be the shorter one.
  const ProgramResult longer =
      run_in(folder, {"measure", "film", "a.mkv", "--against", "short.mkv", "--layout", "mono"});
  EXPECT_THAT(longer.output, testing::HasSubstr("short.mkv ends there"));
}

TEST(MeasureFilmCommand, RefusesWhatDoesNotBelongTogether) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "short", "small", "two", "empty"}) std::filesystem::create_directories(folder / name);
  for (int i = 0; i < 3; ++i) {
    write_image(folder / ("a/f_" + std::to_string(i) + ".png"), Image<Rgb8>(32, 32));
    write_image(folder / ("small/f_" + std::to_string(i) + ".png"), Image<Rgb8>(32, 24));
    if (i < 2) write_image(folder / ("short/f_" + std::to_string(i) + ".png"), Image<Rgb8>(32, 32));
    write_image(folder / ("two/f_" + std::to_string(i) + ".png"), Image<Rgb8>(32, 32));
    write_image(folder / ("two/g_" + std::to_string(i) + ".png"), Image<Rgb8>(32, 32));
  }
  const auto refused = [&](const std::string& film, int exit_code, const std::string& part) {
    expect_refused(folder, {"measure", "film", film, "--against", "a", "--quiet"}, exit_code, part);
  };
  refused("small", 3, "small: is 32x24 pixels, expected 32x32 as a");
  refused("two", 3, "two: has numbered pictures of 2 names");
  refused("empty", 3, "empty: has no numbered pictures");
  refused("nowhere.mp4", 3, "nowhere.mp4");
  expect_refused(folder, {"measure", "film", "a", "--against", "a", "--truth", "empty", "--quiet"}, 3,
                 "flow_forward_0000.flo");
  expect_refused(folder, {"measure", "film", "a"}, 2, "--against is required");
  expect_refused(folder, {"measure", "film", "a", "--against", "a", "--layout", "sideways"}, 2, "sideways");
}

}  // namespace wheatstone::measure_film_test
