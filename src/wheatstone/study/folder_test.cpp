#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/study/analysis_report.h"
#include "wheatstone/study/simulate.h"
#include "wheatstone/study/study_folder.h"
#include "wheatstone/study/trial_table.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone::folder_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::MatchesRegex;

const StudyDesign& design() {
  static const StudyDesign loaded = load_study_design("path-searching-2");
  return loaded;
}

/// Two simulated subjects in a folder.
void write_study(const fs::path& path) {
  const StudyFolder folder(path, design(), true);
  for (int subject = 0; subject < 2; ++subject) write_subject(folder, simulate_subject(design(), {}, subject, 1));
}

TEST(StudyFolder, AnswersComeBack) {
  const TemporaryFolder folder;
  write_study(folder / "data");
  const StudyData data = read_study(folder / "data");
  ASSERT_EQ(data.subjects.size(), 2u);
  const SubjectRecords expected = simulate_subject(design(), {}, 1, 1);
  ASSERT_EQ(data.subjects[1].trials.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(data.subjects[1].trials[i].condition, expected.trials[i].condition);
    EXPECT_EQ(data.subjects[1].trials[i].item, expected.trials[i].item);
    EXPECT_EQ(data.subjects[1].trials[i].response, expected.trials[i].response);
    EXPECT_NEAR(data.subjects[1].trials[i].response_time_s, expected.trials[i].response_time_s, 1e-6);
    EXPECT_NEAR(data.subjects[1].trials[i].head_most_m, expected.trials[i].head_most_m, 1e-6);
  }
  EXPECT_EQ(data.subjects[1].answers, expected.answers);
}

/// What breaks a rule of BIDS 1.9, quoted here, or nothing.
std::string broken_bids_rule(const fs::path& root) {
  // "Every dataset MUST include this file [dataset_description.json] with the following fields: Name, BIDSVersion".
  const auto description = nlohmann::json::parse(bytes_of(root / "dataset_description.json"));
  if (!description.contains("Name") || !description.contains("BIDSVersion")) return "description";
  // "If participants.tsv exists, it MUST contain the column participant_id, which MUST consist of sub-<label> values".
  const std::vector<std::string> participants = lines_of(bytes_of(root / "participants.tsv"));
  if (!participants[0].starts_with("participant_id\t")) return "participants";
  // "sub-<label>[_ses-<label>]_task-<label>[_acq-<label>][_run-<index>]_beh.tsv"; "<label> MUST be alphanumeric".
  const auto is_name = MatchesRegex("sub-[0-9a-zA-Z]+_task-[0-9a-zA-Z]+_beh\\.tsv");
  for (std::size_t i = 1; i < participants.size(); ++i) {
    const std::string id = fields_of(participants[i]).front();
    if (!testing::Value(id, MatchesRegex("sub-[0-9a-zA-Z]+"))) return "participant " + id;
    for (const fs::directory_entry& file : fs::directory_iterator(root / id / "beh")) {
      if (file.path().filename().string().starts_with(".")) continue;
      if (!testing::Value(file.path().filename().string(), is_name)) return file.path().string();
      // "Tabular files MUST be saved as tab delimited values (.tsv) files"; "MUST start with a header line"; "Missing
      // and non-applicable values MUST be coded as n/a".
      const std::vector<std::string> lines = lines_of(bytes_of(file.path()));
      const std::vector<std::string> columns = fields_of(lines[0]);
      for (const std::string& line : lines) {
        if (fields_of(line).size() != columns.size()) return "columns of " + line;
        for (const std::string& field : fields_of(line))
          if (field.empty() || field == "nan") return "empty field in " + line;
      }
      // "For each additional column … the sidecar SHOULD describe"; here each has to be described.
      const std::string task = file.path().filename().string().substr(id.size() + 1);
      const auto sidecar = nlohmann::json::parse(bytes_of(root / (task.substr(0, task.size() - 4) + ".json")));
      for (const std::string& column : columns)
        if (!sidecar.contains(column) || !sidecar[column].contains("Description")) return "sidecar of " + column;
      // "response_time: … in seconds".
      if (sidecar["response_time"]["Units"] != "s") return "units";
    }
  }
  return "";
}

TEST(StudyFolder, KeepsTheRulesOfBids) {
  const TemporaryFolder folder;
  write_study(folder / "data");
  EXPECT_EQ(broken_bids_rule(folder / "data"), "");
  put_bytes((folder / "data") / "participants.tsv", "subject\nsub-01\n");
  EXPECT_EQ(broken_bids_rule(folder / "data"), "participants");
}

TEST(StudyFolder, SimulatedDataAreMarkedInEveryFile) {
  const TemporaryFolder folder;
  write_study(folder / "data");
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder / "data"))
    if (file.is_regular_file() && file.path().filename() != "design.toml") {
      const std::string bytes = bytes_of(file.path());
      EXPECT_TRUE(bytes.find("imulated") != std::string::npos || bytes.find("SIMULATED") != std::string::npos)
          << file.path();
    }
  const StudyData data = read_study(folder / "data");
  const StudyAnalysis analysis = analyse_study(data);
  EXPECT_THAT(analysis_page(data, analysis), HasSubstr("no person took part"));
  for (const auto& [name, table] : analysis_tables(data, analysis))
    EXPECT_THAT(lines_of(table)[1], HasSubstr("simulated")) << name;
}

TEST(StudyFolder, OfAnotherDesignOrKindIsRefused) {
  const TemporaryFolder folder;
  write_study(folder / "data");
  expect_error(ErrorKind::bad_input, "holds data of another design than painting-comfort",
               [&] { StudyFolder(folder / "data", load_study_design("painting-comfort"), true); });
  expect_error(ErrorKind::bad_input, "holds data of simulated observers, which are never mixed with those of people",
               [&] { StudyFolder(folder / "data", design(), false); });
  put_bytes(folder / "notes.txt", "mine");
  expect_error(ErrorKind::bad_input, "is not empty and holds no study",
               [&] { StudyFolder(folder / "", design(), false); });
  expect_error(ErrorKind::bad_input, "is no study", [&] { read_study(folder / "nowhere"); });
}

TEST(StudyFolder, MayGetPublishedMeansLater) {
  const TemporaryFolder folder;
  std::string toml = design().toml;
  toml.erase(toml.find("\n[published"));
  const StudyDesign earlier = parse_study_design(toml, "earlier.toml");
  EXPECT_TRUE(earlier.published.empty());
  const StudyFolder begun(folder / "data", earlier, true);
  EXPECT_NO_THROW(StudyFolder(folder / "data", design(), true));
  toml.replace(toml.find("practice = 6"), 12, "practice = 5");
  expect_error(ErrorKind::bad_input, "another design",
               [&] { StudyFolder(folder / "data", parse_study_design(toml, "other.toml"), true); });
}

TEST(StudyFolder, ATableThatIsBrokenIsNamed) {
  const std::string header = trial_table_header(design());
  const auto parse = [&](const std::string& text) {
    return [&, text] { parse_trial_table(design(), 0, text, "a.tsv", true); };
  };
  expect_error(ErrorKind::bad_input, "a.tsv:1: is of another design", parse("a\tb\n"));
  expect_error(ErrorKind::bad_input, "a.tsv:2: has 1 fields", parse(header + "x\n"));
  std::string row = trial_table_row(design(), 0, simulate_subject(design(), {}, 0, 1).trials[0], true);
  expect_error(ErrorKind::bad_input, "expected a condition of the design", parse(header + "x" + row));
}

TEST(StudyFolder, AStimulusThatIsMissingIsNamed) {
  const TemporaryFolder folder;
  const StudyFolder study(folder / "data", load_study_design("painting-comfort"), false);
  expect_error(ErrorKind::bad_input, "stimuli/01_original_left.png: this stimulus is missing",
               [&] { study.make_stimuli({}); });
}

TEST(StudyFolder, GraphsOfAllItemsAreMade) {
  const TemporaryFolder folder;
  const StudyFolder study(folder / "data", design(), false);
  study.make_stimuli({});
  EXPECT_EQ(std::distance(fs::directory_iterator(study.stimuli() / "graphs"), {}), 106) << "100 and 6 for practice";
  const std::string name = "graphs/item-007_nodes-90_depth-100mm.json";
  EXPECT_EQ(graph_from_json(bytes_of(study.stimuli() / name), name),
            graph_of_item(design(), 6, conditions_of_group(design(), 0)[0].shown, {}));
}

TEST(TrialLog, ALineThatWasHalfWrittenIsCutOff) {
  const TemporaryFolder folder;
  { TrialLog(folder / "a.tsv", "head\n").append("one\n"); }
  put_bytes(folder / "a.tsv", bytes_of(folder / "a.tsv") + "tw");
  { TrialLog(folder / "a.tsv", "head\n").append("two\n"); }
  EXPECT_EQ(bytes_of(folder / "a.tsv"), "head\none\ntwo\n");
}

/// While it lives, files of this process grow no further than this, as on a full disk.
class LargestFile {
 public:
  explicit LargestFile(std::size_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LargestFile() { setrlimit(RLIMIT_FSIZE, &before_); }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;

 private:
  rlimit before_{};
};

TEST(TrialLog, AnAnswerIsNotLostOnAFullDisk) {
  const TemporaryFolder folder;
  const std::string header = "head\tobserver\n", full(5000, 'x'), answers = "one\tperson\ntwo\tperson\n";
  {
    TrialLog log(folder / "a.tsv", header);
    log.append(full + "\n");
    const LargestFile limit(header.size() + full.size() + 5);
    expect_error(ErrorKind::cannot_read_write, "the answer is kept in", [&] { log.append(answers); });
  }
  EXPECT_EQ(read_trial_log(folder / "a.tsv"), header + full + "\n" + answers) << "the analysis sees it";
  TrialLog log(folder / "a.tsv", header);
  EXPECT_EQ(bytes_of(folder / "a.tsv"), header + full + "\n" + answers);
  log.finish();
  EXPECT_EQ(read_trial_log(folder / "a.tsv"), bytes_of(folder / "a.tsv"));
}

TEST(TrialLog, AReserveThatHoldsNoAnswerIsRefused) {
  const TemporaryFolder folder;
  const std::string header = "head\tobserver\n";
  { const TrialLog log(folder / "a.tsv", header); }
  const std::string table = bytes_of(folder / "a.tsv");
  for (const char* kept : {"x", "x\n", "1\t2\tperson\n\n", "1\tnobody\n\n", "1\tperson\nx\n\n", "\xff\n\n",
                           "x\n\n1\tperson\n", "1\tperso", "\t", "\xff"}) {
    put_bytes(folder / ".a.tsv.reserve", kept);
    SCOPED_TRACE(kept);
    const auto refused = [&](const std::function<void()>& open) {
      expect_error(ErrorKind::bad_input, ".a.tsv.reserve: holds no answer of this study", open);
    };
    refused([&] { read_trial_log(folder / "a.tsv"); });
    refused([&] { const TrialLog log(folder / "a.tsv", header); });
    EXPECT_EQ(bytes_of(folder / "a.tsv"), table);
  }
}

}  // namespace wheatstone::folder_test
