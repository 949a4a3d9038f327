#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/comfort_stimuli.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/study/path_graph.h"
#include "wheatstone/study/study_design.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::study_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(StudyCommand, DrawsGraphsOfWhichHalfAreYes) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"study", "stimuli", "--count", "2", "--size", "120x90", "--nodes", "30", "-o", "out", "--quiet"},
                  {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto graph = [&](const char* name) { return graph_from_json(bytes_of(folder / name), name); };
  EXPECT_TRUE(has_path_of_two(graph("out/graph_000.json")));
  EXPECT_FALSE(has_path_of_two(graph("out/graph_001.json")));
  EXPECT_THAT(files_in(folder / "out"), testing::Contains("graph_001_right.png"));
}

TEST(StudyCommand, ManyViewsAreNumbered) {
  const TemporaryFolder folder;
  run_program({"study", "stimuli", "--count", "1", "--views", "3", "--size", "120x90", "--quiet"},
              {.folder = folder / ""});
  EXPECT_THAT(files_in(folder / "stimuli"),
              testing::UnorderedElementsAre("graph_000.json", "graph_000_view_000.png", "graph_000_view_001.png",
                                            "graph_000_view_002.png"));
}

TEST(StudyCommand, AStimulusThatCannotBeDrawnIsRefused) {
  expect_refused(TemporaryFolder(), {"study", "stimuli", "--nodes", "91"}, 3,
                 "nodes: is 91, expected a multiple of three");
}

TEST(StudyCommand, MakesAStudyOfComfortOfAFolderOfPhotographs) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "photographs");
  constexpr int photographs = 10;
  for (int number = 1; number <= photographs; ++number) {
    const StereoPair pair = still_for_test(128, 96, static_cast<std::uint64_t>(number));
    write_image(folder / fmt::format("photographs/{}_L.png", number), pair.left);
    write_image(folder / fmt::format("photographs/{}_R.png", number), pair.right);
  }
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "study");
    words.emplace_back("--json");
    const ProgramResult result = run_program(words, {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output);
  };
  EXPECT_EQ(run({"stimuli", "comfort", "--photographs", "photographs", "-o", "comfort"})["photographs"], photographs);
  for (const char* name : {"design.toml", "instructions.html", "photographs.tsv"})
    EXPECT_TRUE(fs::exists(folder / (std::string("comfort/") + name))) << name;
  EXPECT_EQ(files_in(folder / "comfort/stimuli").size(), 6u * photographs);
  EXPECT_THAT(bytes_of(folder / "comfort/instructions.html"), HasSubstr("wheatstone study run comfort/design.toml"));
  // The consistent eyes agree better than those that were painted apart.
  const auto difference_of = [&](const std::string& version) {
    const std::string name = "comfort/stimuli/02_", left = "_left.png", right = "_right.png";
    const ProgramResult result =
        run_program({"measure", "stereo", name + version + left, name + version + right, "--photographs",
                     name + "original" + left, name + "original" + right, "--json"},
                    {.folder = folder / ""});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output)["stylised"]["left_right_mean_absolute"].get<double>();
  };
  EXPECT_LT(2 * difference_of("consistent"), difference_of("inconsistent"));
  // The study is rehearsed, and the order of the paper comes out.
  run({"simulate", "comfort/design.toml", "--published", "-o", "rehearsal"});
  const auto rating = run({"analyse", "rehearsal", "--against", "published", "-o", "analysis"})["published"]["rating"];
  EXPECT_EQ(rating["rank_correlation"], 1);
  for (const auto& [condition, beside] : rating["conditions"].items())
    EXPECT_NEAR(beside["mean"].get<double>(), beside["published_mean"].get<double>(), 0.2) << condition;
  expect_refused(folder, {"study", "stimuli", "comfort"}, 2, "--photographs");
  expect_refused(folder, {"study", "stimuli", "dots", "--photographs", "photographs"}, 2, "--photographs");
  expect_refused(folder, {"study", "stimuli", "comfort", "--photographs", "photographs", "--nodes", "30"}, 2,
                 "--nodes");
  expect_refused(folder, {"study", "simulate", "two-or-forty-five", "--published"}, 3, "has no published means");
}

TEST(StudyCommand, DesignsOfComfortAreBalancedForAnyNumberOfPhotographs) {
  for (const int count : {3, 4, 10, 20, 23}) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) names.push_back(fmt::format("{:02}", i + 1));
    const StudyDesign design = parse_study_design(comfort_design(names), "design.toml");
    EXPECT_EQ(design.item_count, count);
    EXPECT_EQ(design.repetitions, std::min(count / 3, 4));
    EXPECT_TRUE(count_balance(design).items) << count;
    EXPECT_LE(design.subjects, 30 + 3 * count);
  }
  expect_error(ErrorKind::wrong_usage, "there are 2 photographs", [] { comfort_design({"a", "b"}); });
}

TEST(StudyCommand, TellsTheThesisDegreesOfFreedom) {
  const ProgramResult first = run_program({"study", "design", "path-searching-1"});
  EXPECT_THAT(first.output, HasSubstr("depth_cm: F1(1, 38), F2(1, 77)\n"));
  EXPECT_THAT(first.output, HasSubstr("trials of a subject: 78, after 6 for practice"));
  const auto second = nlohmann::json::parse(run_program({"study", "design", "path-searching-2", "--json"}).output);
  EXPECT_EQ(second["effects"][0]["df_error_subjects"], 56);
  EXPECT_EQ(second["effects"][0]["df_error_items"], 396);
}

TEST(StudyCommand, ADesignIsCopiedToBeChanged) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program({"study", "design", "painting-comfort", "-o", "mine.toml"}, {.folder = folder / ""}).exit_code,
            0);
  const std::string toml = bytes_of(folder / "mine.toml");
  EXPECT_EQ(run_program({"study", "design", "mine.toml"}, {.folder = folder / ""}).exit_code, 0);
  put_bytes(folder / "mine.toml", std::string(toml).replace(toml.find("subjects = 30"), 13, "subjects = 31"));
  expect_refused(folder, {"study", "design", "mine.toml"}, 3,
                 "31 subjects cannot be balanced over 3 conditions; 30 or 33 can");
  expect_refused(folder, {"study", "design", "mine.toml", "-o", "mine.toml"}, 3, "31 subjects");
}

TEST(StudyCommand, ASimulatedStudyIsAnalysed) {
  const TemporaryFolder folder;
  const ProgramRun here{.folder = folder / ""};
  ASSERT_EQ(
      run_program({"study", "simulate", "path-searching-2", "--effect", "views_per_10cm=2:9", "-o", "data", "--quiet"},
                  here)
          .exit_code,
      0);
  const ProgramResult result = run_program({"study", "analyse", "data", "-o", "out", "--json"}, here);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto facts = nlohmann::json::parse(result.output);
  EXPECT_EQ(facts["simulated"], true);
  EXPECT_EQ(facts["trials"], 1500);
  EXPECT_LT(facts["measures"]["response_time"]["by_subjects"][0]["p"], 1e-4);
  EXPECT_EQ(facts["measures"]["response_time"]["by_subjects"][0]["df"], (std::vector<double>{4, 56}));
  EXPECT_THAT(files_in(folder / "out"),
              testing::UnorderedElementsAre("analysis.html", "comparisons.tsv", "effects.tsv", "head_movement.tsv",
                                            "means.tsv", "questions.tsv"));
  const ProgramResult compared =
      run_program({"study", "analyse", "data", "--against", "published", "-o", "compared", "--json"}, here);
  const auto beside = nlohmann::json::parse(compared.output)["published"]["response_time"];
  EXPECT_EQ(beside["conditions"]["views_per_10cm=2"]["published_mean"], 19.49);
  EXPECT_THAT(files_in(folder / "compared"), testing::Contains("published.tsv"));
  expect_refused(folder, {"study", "simulate", "painting-comfort", "-o", "data"}, 3, "holds data of another design");
  EXPECT_EQ(run_program({"study", "simulate", "path-searching-2", "--effect", "views_per_10cm=2:9", "-o", "data"}, here)
                .exit_code,
            0)
      << "the same simulation";
  expect_refused(folder, {"study", "simulate", "path-searching-2", "-o", "data", "--seed", "7"}, 3,
                 "data: holds another simulation");
  expect_refused(folder, {"study", "analyse", "out"}, 3, "out: is no study");
  expect_refused(folder, {"study", "simulate", "path-searching-2", "--effect", "depth"}, 2,
                 "--effect: is 'depth', expected FACTOR=LEVEL:SECONDS");
}

}  // namespace wheatstone::study_test
