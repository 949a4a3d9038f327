// What `wheatstone rotoscope` makes for looking at: films for displays, their names, sizes and codecs, what info and
// pack say of them; and the depth budget of two eyes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/display_argument.h"
#include "cli/run_program.h"
#include "scenes/moving_picture.h"

namespace wheatstone::display_film_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void make_synthetic(const TemporaryFolder& folder, int frames) {
  const ProgramResult result = run_program({"synth", "film", "-o", "film", "--size", "96x64", "--frames",
                                            std::to_string(frames), "--samples", "1", "--quiet"},
                                           {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
}

nlohmann::json facts_of(const TemporaryFolder& folder, const Words& words) {
  Words line = words;
  line.insert(line.end(), {"--quiet", "--json"});
  const ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return nlohmann::json::parse(result.output, nullptr, false);
}

TEST(DisplayFilm, AQuiltFilmHasTheNameSizeAndFramesThatTheDisplayTakes) {
  const TemporaryFolder folder;
  make_synthetic(folder, 3);
  const auto facts = facts_of(folder, {"rotoscope", "film", "--display", "looking-glass-portrait", "--size", "21x28",
                                       "--preset", "ultrafast", "-o", "painted"});
  EXPECT_EQ(facts["output"], "painted_qs8x6a0.75.mp4");
  EXPECT_EQ(facts["views"], 48);
  EXPECT_EQ(facts["view_width"], 21);
  const std::vector<Frame> frames = frames_of(folder / "painted_qs8x6a0.75.mp4");
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames.front().picture.width(), 168);
  EXPECT_EQ(frames.front().picture.height(), 168);

  const auto told = facts_of(folder, {"info", "painted_qs8x6a0.75.mp4"});
  EXPECT_EQ(told["quilt"], "8x6");
  EXPECT_EQ(told["views"], 48);
  EXPECT_EQ(told["view_width"], 21);
  EXPECT_EQ(told["view_height"], 28);
  EXPECT_EQ(told["view_aspect"], 0.75);
  EXPECT_EQ(told["frames"], 3);
  EXPECT_EQ(told["codec"], "h264");
  expect_refused(folder, {"pack", "painted_qs8x6a0.75.mp4", "--to", "views", "-o", "views"}, 2,
                 "--to: there is no layout 'views' of films, expected two-files, anaglyph or one of");
}

TEST(DepthBudgetOfAFilm, IsComfortableByDefaultAndMeasuringTellsOfIt) {
  const TemporaryFolder folder;
  make_synthetic(folder, 3);
  const auto output_of = [&](const Words& words) {
    const ProgramResult result = run_program(words, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return result.output;
  };
  const Words measure{"measure", "film", "o.mp4", "--against", "film", "--quiet"};
  const auto facts = facts_of(folder, {"rotoscope", "film", "--preset", "ultrafast", "-o", "o.mp4"});
  EXPECT_EQ(facts["moved_frames"], 3);
  EXPECT_LT(facts["presented_separation"], 1);
  EXPECT_THAT(output_of(measure),
              testing::HasSubstr("\no.mp4: The eyes were moved for looking at in 3 frames, nearest together at 0."));
  EXPECT_EQ(facts_of(folder, measure)["notes"].size(), 1u);
  fs::remove(folder / "o.mp4");
  EXPECT_THAT(output_of({"rotoscope", "film", "--preset", "ultrafast", "-o", "o.mp4"}),
              testing::ContainsRegex("\ndepth            reduced in 3 frames, to [0-9]+ % or more, to stay comfortable "
                                     ".3 % of width.; --depth-budget full keeps it\n"));
  fs::remove(folder / "o.mp4");
  const auto full =
      facts_of(folder, {"rotoscope", "film", "--preset", "ultrafast", "--depth-budget", "full", "-o", "o.mp4"});
  EXPECT_EQ(full["moved_frames"], 0);
  EXPECT_EQ(full["presented_separation"], 1);
  EXPECT_THAT(output_of(measure), testing::Not(testing::HasSubstr("moved")));
}

TEST(DepthBudgetOfAFilm, IsRefusedWhereItHasNoEffect) {
  const TemporaryFolder folder;
  make_film(folder / "one.mp4", 3, {.preset = "ultrafast"});
  const auto refused = [&](const Words& words, int exit_code, const std::string& part) {
    Words line{"rotoscope", "one.mp4", "--layout", "mono", "--quiet", "--depth-budget"};
    line.insert(line.end(), words.begin(), words.end());
    expect_refused(folder, line, exit_code, part);
  };
  refused({"3%"}, 2, "--depth-budget: has no effect on a film of one eye");
  refused({"3%", "--display", "step-9"}, 2, "--depth-budget: has no effect with --display; --span sets");
  refused({"full", "-o", "m_%04d.wst"}, 2, "--depth-budget: has no effect on marks (.wst)");
  refused({"deep"}, 2, "--depth-budget");
}

TEST(DisplayFilm, ATypedEndingKeepsItsName) {
  const TemporaryFolder folder;
  make_synthetic(folder, 1);
  const auto facts = facts_of(folder, {"rotoscope", "film", "--display", "looking-glass-portrait", "--size", "21x28",
                                       "--codec", "ffv1", "-o", "a.mkv"});
  EXPECT_EQ(facts["output"], "a.mkv");
  EXPECT_EQ(frames_of(folder / "a.mkv").size(), 1u);
}

TEST(DisplayFilmLong, MemoryDoesNotGrowWithTheFilm) {
  const TemporaryFolder folder;
  put_bytes(folder / "broad.toml", "radii = [24, 12]\n");
  const auto peak = [&](const std::string& frames) {
    const ProgramResult made = run_program(
        {"synth", "film", "-o", "film" + frames, "--size", "160x96", "--frames", frames, "--samples", "1", "--quiet"},
        {.folder = folder / ""});
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    const ProgramResult result =
        run_program({"rotoscope", "film" + frames, "--display", "looking-glass-portrait", "--size", "105x140",
                     "--style", "broad.toml", "--flow", "dis", "--checkpoint", "12", "--threads", "2", "--preset",
                     "ultrafast", "--quiet", "-o", "painted" + frames},
                    {.folder = folder / "", .own_process = true});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(frames_of(folder / ("painted" + frames + "_qs8x6a0.75.mp4")).size(), std::stoul(frames));
    return static_cast<double>(result.peak_bytes);
  };
  const double of_short = peak("24"), of_long = peak("96");
  RecordProperty("short_MiB", std::to_string(of_short / (1 << 20)));
  RecordProperty("long_MiB", std::to_string(of_long / (1 << 20)));
  // A quilt kept of every frame would be 72 x 840 x 840 x 3 bytes, 145 MiB.
  EXPECT_LT(of_long, 1.05 * of_short);
}

// What the displays' makers publish, and what H.264 up to level 5.2 holds.
TEST(DisplayFilm, QuiltsTooLargeForH264AreHevc) {
  const auto display = [](const char* name, std::optional<PictureSize> size = {}) {
    return cli::film_display_from({.name = name, .size = size}).value();
  };
  const FilmDisplay portrait = display("looking-glass-portrait");
  EXPECT_EQ(portrait.quilt->columns * portrait.views.width, 3360);
  EXPECT_EQ(portrait.quilt->rows * portrait.views.height, 3360);
  for (const char* name :
       {"looking-glass-go", "looking-glass-portrait", "looking-glass-16", "looking-glass-32", "looking-glass-65"})
    EXPECT_EQ(cli::codec_for(display(name)), "hevc") << name;
  EXPECT_EQ(cli::codec_for(display("looking-glass-portrait", PictureSize{210, 280})), "h264");
  EXPECT_EQ(cli::codec_for(display("step-9")), "h264");
}

TEST(DisplayFilm, WhatCannotBeShownIsRefusedInOneLine) {
  const TemporaryFolder folder;
  make_film(folder / "one.mp4", 3, {.preset = "ultrafast"});
  const auto refused = [&](const Words& words, int exit_code, const std::string& part) {
    Words line{"rotoscope", "one.mp4", "--layout", "mono", "--quiet"};
    line.insert(line.end(), words.begin(), words.end());
    expect_refused(folder, line, exit_code, part);
  };
  refused({"--display", "looking-glass-portrait"}, 3, "one.mp4: has one eye, expected two, or --depth, for a display");
  refused({"--display", "desk-stereo"}, 2, "--display: desk-stereo takes neither quilts nor lenticular pictures");
  refused({"--display", "moon"}, 2, "no display 'moon'");
  refused({"--display", "step-9", "--output-layout", "sbs"}, 2, "--output-layout: has no effect with --display");
  refused({"--display", "step-9", "-o", "m_%04d.wst"}, 2, "--display: has no effect on marks");
  refused({"--span", "2"}, 2, "--span requires --display");
}

}  // namespace wheatstone::display_film_test
