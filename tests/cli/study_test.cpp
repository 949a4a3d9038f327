#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "temporary_folder.h"
#include "wheatstone/study/path_graph.h"

namespace wheatstone::study_test {

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
