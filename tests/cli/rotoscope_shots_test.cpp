// Shots files, as `wheatstone rotoscope` writes and reads them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace wheatstone::rotoscope_shots_test
