// Shots files, as `wheatstone rotoscope` writes and reads them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "temporary_folder.h"

namespace wheatstone::rotoscope_shots_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

/// A film of 'synth film', in the folder "film": 8 frames with a cut after 4.
void make_synthetic(const TemporaryFolder& folder) {
  const ProgramResult result = run_program({"synth", "film", "-o", "film", "--size", "160x96", "--frames", "8", "--cut",
                                            "4", "--samples", "1", "--noise", "0", "--quiet"},
                                           {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
}

ProgramResult rotoscope(const TemporaryFolder& folder, const Words& words) {
  Words line{"rotoscope", "film", "--quiet"};
  line.insert(line.end(), words.begin(), words.end());
  return run_program(line, {.folder = folder / ""});
}

TEST(RotoscopeShots, AreListedWithoutPainting) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  const ProgramResult result = rotoscope(folder, {"--list-shots", "cuts.toml", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto facts = nlohmann::json::parse(result.output);
  ASSERT_EQ(facts["shots"].size(), 2u);
  EXPECT_EQ(facts["shots"][1]["begin"], 5);
  EXPECT_EQ(facts["shots"][1]["frames"], 4);
  EXPECT_TRUE(fs::exists(folder / "cuts.toml"));
  EXPECT_TRUE(fs::exists(folder / "cuts_002.jpg"));
  EXPECT_FALSE(fs::exists(folder / "painted.mp4"));
}

TEST(RotoscopeShots, AListTakesNoOptionOfPainting) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  for (const Words& words : {Words{"--style", "oil"}, {"-o", "a.mp4"}, {"--from", "0.1"}, {"--plan", "p"}}) {
    Words line{"--list-shots", "cuts.toml"};
    line.insert(line.end(), words.begin(), words.end());
    const ProgramResult result = rotoscope(folder, line);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.errors, HasSubstr("has no effect with --list-shots")) << words[0];
    EXPECT_FALSE(fs::exists(folder / "cuts.toml")) << words[0];
  }
}

TEST(RotoscopeShots, ArePreviewedOnOneSheetWithoutPainting) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  const ProgramResult result = rotoscope(folder, {"--style", "posterise", "--preview", "sheet.jpg", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto facts = nlohmann::json::parse(result.output);
  EXPECT_EQ(facts["shots"], 2);
  EXPECT_EQ(facts["frames"], 8);
  EXPECT_GT(facts["expected_seconds"], 0);
  EXPECT_GT(facts["expected_megabytes"], 0);
  EXPECT_TRUE(fs::exists(folder / "sheet.jpg"));
  EXPECT_FALSE(fs::exists(folder / "painted.mp4"));
  for (const auto& [words, message] : std::initializer_list<std::pair<Words, std::string>>{
           {{"--preview", "sheet.mp4"}, "sheet.mp4: expected the name of a picture"},
           {{"--preview", "a.png", "-o", "a.png"}, "--preview: a.png is the same file as that of --output"},
           {{"--preview", "a.png", "-o", "a_%d.wst"}, "--preview: has no effect on marks (.wst)"},
           {{"--preview", "a.png", "--plan", "a.plan"}, "--preview excludes --plan"},
           {{"--preview", "a.png", "--truth", "film"}, "--preview excludes --truth"}}) {
    const ProgramResult refused = rotoscope(folder, words);
    EXPECT_EQ(refused.exit_code, 2) << message;
    EXPECT_THAT(refused.errors, HasSubstr(message));
    EXPECT_EQ(std::ranges::count(refused.errors, '\n'), 1) << refused.errors;
  }
}

/// Two styles in the film of make_synthetic, with a cut more than it has.
void write_shots(const TemporaryFolder& folder) {
  put_bytes(folder / "s.toml", R"([[shot]]
begin = 1
style = "mosaic"
[[shot]]
begin = 5
radii = [8, 4]
[[shot]]
begin = "0:00.25"
style = "posterise"
)");
}

TEST(RotoscopeShots, ArePaintedAlikeInTheWholeFilmAndInAPartOfIt) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  write_shots(folder);
  const Words all{"--style", "impressionist", "--shots", "s.toml", "-o", "all_%d.wst"};
  const ProgramResult whole = rotoscope(folder, all);
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  EXPECT_THAT(whole.output, HasSubstr("8 frames in 3 scenes"));
  // Frames 5 and 6 are the second shot.
  const ProgramResult part = rotoscope(folder, {"--style", "impressionist", "--shots", "s.toml", "--from", "0.166",
                                                "--to", "0.25", "-o", "part_%d.wst"});
  ASSERT_EQ(part.exit_code, 0) << part.errors;
  EXPECT_TRUE(bytes_of(folder / "part_1.wst") == bytes_of(folder / "all_5.wst"));
  EXPECT_TRUE(bytes_of(folder / "part_2.wst") == bytes_of(folder / "all_6.wst"));
  EXPECT_FALSE(fs::exists(folder / "part_3.wst"));
  // And as the options of that shot paint them.
  const ProgramResult alone = rotoscope(
      folder, {"--style", "impressionist", "--radii", "8,4", "--from", "0.166", "--to", "0.25", "-o", "alone_%d.wst"});
  ASSERT_EQ(alone.exit_code, 0) << alone.errors;
  EXPECT_TRUE(bytes_of(folder / "alone_2.wst") == bytes_of(folder / "all_6.wst"));
}

TEST(RotoscopeShots, ThatAreWrongAreOneLineThatNamesThePlace) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  const auto expect = [&](const std::string& toml, const Words& words, const std::string& message) {
    put_bytes(folder / "bad.toml", toml);
    Words line{"--shots", "bad.toml"};
    line.insert(line.end(), words.begin(), words.end());
    const ProgramResult result = rotoscope(folder, line);
    EXPECT_EQ(result.exit_code, 3) << message;
    EXPECT_THAT(result.errors, HasSubstr("bad.toml: " + message));
    EXPECT_EQ(std::ranges::count(result.errors, '\n'), 1) << result.errors;
  };
  const std::string first = "[[shot]]\nbegin = 1\n";
  expect(first + "style = \"oils\"\n", {}, "shot 1, line 3: style: there is no 'oils'");
  expect(first + "last = 5\n[[shot]]\nbegin = 5\n", {}, "shot 1, line 1: ends with frame 5, but the next");
  expect(first + "[[shot]]\nbegin = 9\n", {}, "shot 2, line 3: begins beyond the end of the film, which has 8 frames");
  expect(first + "zero-parallax = 2\n", {"-o", "m_%d.wst"}, "shot 1, line 3: 'zero-parallax' has no effect on marks");
  expect(first + "depth-budget = 0.1\n", {"--display", "looking-glass-portrait"},
         "shot 1, line 3: 'depth-budget' has no effect with --display");
  const std::string key = first + "[[shot.key]]\nat = 1\n";
  expect(key + "grid = 2.0\n", {}, "shot 1, key 1, line 5: 'grid' does not move, expected at and one of depth-budget,");
  expect(key + "opacity = 0.5\n[[shot.key]]\nat = 9\nopacity = 0.8\n", {},
         "shot 1, key 2, line 6: lies beyond the end of the film, which has 8 frames");
  expect(key + "zero-parallax = 2\n", {"--display", "looking-glass-portrait"},
         "shot 1, key 1, line 5: 'zero-parallax' has no effect in a key with --display; a shot is planned for one");
  EXPECT_FALSE(fs::exists(folder / "painted.mp4"));
}

TEST(RotoscopeShots, AreRefusedWhereSomethingElseSaysThem) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  write_shots(folder);
  for (const auto& [words, message] : std::initializer_list<std::pair<Words, std::string>>{
           {{"--truth", "film"}, "--shots: has no effect with --truth"},
           {{"--list-shots", "t.toml"}, "--shots: has no effect with --list-shots"},
           {{"--draw"}, "--shots: has no effect with --draw"},
           {{"-o", "s.toml"}, "s.toml: is the same file as the input s.toml"}}) {
    Words line{"--shots", "s.toml"};
    line.insert(line.end(), words.begin(), words.end());
    const ProgramResult result = rotoscope(folder, line);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.errors, HasSubstr(message));
  }
}

TEST(RotoscopeShots, OnTwosFindsTheCutsByItself) {
  const TemporaryFolder folder;
  make_synthetic(folder);
  const ProgramResult result = rotoscope(folder, {"--style", "posterise", "--on-twos", "-o", "t_%d.wst"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("8 frames in 2 scenes"));
  EXPECT_TRUE(bytes_of(folder / "t_1.wst") == bytes_of(folder / "t_2.wst"));
  EXPECT_FALSE(bytes_of(folder / "t_2.wst") == bytes_of(folder / "t_3.wst"));
  const ProgramResult truth = rotoscope(folder, {"--truth", "film", "--on-twos"});
  EXPECT_EQ(truth.exit_code, 2);
  EXPECT_THAT(truth.errors, HasSubstr("--on-twos: has no effect with --truth"));
}

}  // namespace wheatstone::rotoscope_shots_test
