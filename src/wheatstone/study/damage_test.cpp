// Files of a study that were damaged, or edited by other programs: what is wrong is refused with its file and line, and
// what means the same is read.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/study/analysis_report.h"
#include "wheatstone/study/simulate.h"
#include "wheatstone/study/study_folder.h"

namespace wheatstone::damage_test {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr auto table = "sub-01/beh/sub-01_task-paths_beh.tsv";
constexpr auto participants = "participants.tsv";
constexpr auto questionnaire = "phenotype/questionnaire.tsv";
constexpr auto description = "dataset_description.json";

/// Four trials for each of four subjects, and one question.
const StudyDesign& path_design() {
  static const StudyDesign design = parse_study_design(
      "name = 'small'\ntask_label = 'paths'\nsubjects = 4\nrepetitions = 2\n[shown]\nnodes = 30\n"
      "[[factor]]\nname = 'views_per_10cm'\nlevels = [0, 8]\n"
      "[[question]]\nname = 'tired'\nleast = 1\nmost = 5\n",
      "small.toml");
  return design;
}

const StudyDesign& rating_design() {
  static const StudyDesign design = parse_study_design(
      "name = 'rated'\ntask_label = 'comfort'\ntask = 'rating'\nsubjects = 4\nrepetitions = 1\n"
      "[pictures]\nitems = ['a', 'b']\nleft = '{item}_{version}.png'\n"
      "[[factor]]\nname = 'version'\nlevels = ['x', 'y']\n[[factor]]\nname = 'group'\nbetween = true\nlevels = ['m', "
      "'n']\n",
      "rated.toml");
  return design;
}

/// Two simulated subjects in a folder.
void write_study(const fs::path& path, const StudyDesign& design) {
  const StudyFolder folder(path, design, true);
  for (int subject = 0; subject < 2; ++subject) write_subject(folder, simulate_subject(design, {}, subject, 1));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << " in " << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The text with each line end by CR and LF.
std::string with_windows_ends(const std::string& text) {
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  return windows;
}

/// A table with another value in a column of a line, which is counted from 1 on.
std::function<std::string(std::string)> put(int line, int column, const std::string& value) {
  return [=](const std::string& text) {
    std::size_t begin = 0;
    for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
    for (int i = 0; i < column; ++i) begin = text.find('\t', begin) + 1;
    return text.substr(0, begin) + value + text.substr(text.find_first_of("\t\n", begin));
  };
}

std::function<std::string(std::string)> append(const std::string& line) {
  return [=](const std::string& text) { return text + line; };
}

/// The line of a text, with its end.
std::string line_of(const std::string& text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
  return text.substr(begin, text.find('\n', begin) + 1 - begin);
}

/// Texts in place of whatever was there.
std::function<std::string(std::string)> instead(const std::string& text) {
  return [=](const std::string&) { return text; };
}

std::function<std::string(std::string)> replace(const std::string& from, const std::string& to) {
  return [=](const std::string& text) { return replaced(text, from, to); };
}

struct Damage {
  const StudyDesign& design;
  const char* file;
  std::function<std::string(std::string)> change;
  std::string message;
};

std::vector<Damage> damages_of_trials() {
  // trial_type 0, response_time 1, stim_file 2, trial 3, item 4, views_per_10cm 5, expected 6, response 7, correct 8,
  // head_least 9, head_most 10, log_delay 11, observer 12
  const StudyDesign& paths = path_design();
  const auto twice = [](const std::string& text) { return text + line_of(text, 2); };
  const auto doubled = [](const std::string& text) { return text + text; };
  const auto same_item = [](const std::string& text) {
    return replaced(text, line_of(text, 3), put(1, 3, "2")(line_of(text, 2)));
  };
  return {{paths, table, put(3, 1, "-1.5"), ":3: response_time is '-1.5', expected a number from 0 to 86400"},
          {paths, table, put(3, 1, "inf"), ":3: response_time is 'inf'"},
          {paths, table, put(3, 1, "nan"), ":3: response_time is 'nan'"},
          {paths, table, put(3, 1, "n/a"), ":3: response_time is 'n/a'"},
          {paths, table, put(3, 1, "1e300"), ":3: response_time is '1e300'"},
          {paths, table, put(3, 3, "1.5"), ":3: trial is '1.5', expected a whole number from 1 to 4"},
          {paths, table, put(3, 3, "99999999999"), ":3: trial is '99999999999'"},
          {paths, table, put(3, 3, "1"), ":3: trial 1 stands there twice"},
          {paths, table, twice, ":6: trial 1 stands there twice"},
          {paths, table, same_item, ":3: item-"},
          {paths, table, put(3, 2, "other.json"), ":3: stim_file is 'other.json', expected 'graphs/item-"},
          {paths, table, put(3, 5, "7"), ":3: views_per_10cm is '7', expected '"},
          {paths, table, put(3, 6, "maybe"), ":3: expected is 'maybe', expected '"},
          {paths, table, put(3, 7, "perhaps"), ":3: response is 'perhaps', expected yes or no"},
          {paths, table, put(3, 8, "maybe"), ":3: correct is 'maybe', expected '"},
          {paths, table, put(3, 9, "inf"), ":3: head_least is 'inf'"},
          {paths, table, put(3, 11, "-3"), ":3: log_delay is '-3'"},
          {paths, table, put(3, 12, "person"), ":3: observer is 'person', expected 'simulated'"},
          {paths, table, replace("trial_type\tresponse_time", "response_time\ttrial_type"),
           ":1: is of another design, expected the columns of small"},
          {paths, table, instead(""), ": is empty, expected"},
          {paths, table, replace("\t", std::string(1, '\0')), ":1: "},
          {paths, table, doubled, ":6: "}};
}

std::vector<Damage> damages_of_ratings() {
  // trial_type, response_time, stim_file, trial, item, version, group, expected, response
  constexpr auto ratings = "sub-01/beh/sub-01_task-comfort_beh.tsv";
  const StudyDesign& rated = rating_design();
  return {{rated, ratings, put(2, 8, "6"), ":2: response is '6', expected a whole number from 1 to 5"},
          {rated, ratings, put(2, 8, "0"), ":2: response is '0'"},
          {rated, ratings, put(2, 8, "2.5"), ":2: response is '2.5'"},
          {rated, ratings, put(2, 8, "n/a"), ":2: response is 'n/a'"},
          {rated, ratings, put(2, 6, "n"), ":2: group is 'n', expected 'm'"},
          {rated, participants, put(2, 1, "n"), ":2: group is 'n', expected 'm'"}};
}

std::vector<Damage> damages_of_lists() {
  const StudyDesign& paths = path_design();
  const auto without_second = [](const std::string& text) { return replaced(text, line_of(text, 3), ""); };
  return {{paths, participants, append("sub-01\tsimulated\n"), ":4: sub-01 stands there twice"},
          {paths, participants, append("sub-1\tsimulated\n"), ":4: 'sub-1' is no subject"},
          {paths, participants, append("peter\tsimulated\n"), ":4: 'peter' is no subject"},
          {paths, participants, append("sub-03\n"), ":4: has 1 fields, expected 2"},
          {paths, participants, put(3, 1, "person"), ":3: observer is 'person', expected 'simulated'"},
          {paths, participants, put(1, 0, "subject"), ":1: has no column participant_id"},
          {paths, participants, put(1, 1, "participant_id"), ":1: has two columns participant_id"},
          {paths, participants, without_second, ": sub-02 is missing, whose folder is there"},
          {paths, questionnaire, append("sub-01\t3\tsimulated\n"), ":4: sub-01 stands there twice"},
          {paths, questionnaire, append("sub-04\t3\tsimulated\n"), ":4: sub-04 is not in participants.tsv"},
          {paths, questionnaire, put(3, 1, "6"), ":3: tired is '6', expected a whole number from 1 to 5"},
          {paths, questionnaire, put(3, 1, "12"), ":3: tired is '12'"},
          {paths, questionnaire, put(3, 1, "x"), ":3: tired is 'x'"},
          {paths, questionnaire, put(3, 2, "x"), ":3: observer is 'x', expected 'simulated'"},
          {paths, questionnaire, put(1, 1, "fired"), ":1: has no column tired"},
          {paths, questionnaire, put(3, 0, "sub-02\t4"), ":3: has 4 fields, expected 3"},
          {paths, questionnaire, instead(""), ": is empty"}};
}

std::vector<Damage> damages_of_description() {
  const StudyDesign& paths = path_design();
  constexpr auto none = ": is no description";
  const std::string deep(100'000, '[');
  std::vector<Damage> damages;
  for (const std::string& text : {std::string(), std::string("[]"), std::string("null"), std::string("{}"),
                                  std::string("{\"Simulated\": true"), std::string("{\"Simulated\": 1}"),
                                  std::string(R"({"Simulated": "true"})"), std::string(R"({"Simulated": null})"),
                                  std::string("{\"Simulated\": [true]}"), std::string("{\"simulated\": true}"),
                                  std::string("\xff\xfe{}"), std::string("{\"Simulated\": true, \"Name\": \"\xff\"}"),
                                  std::string("{\"Simulated\": true}}"), std::string("{'Simulated': true}"), deep})
    damages.push_back({paths, description, instead(text), none});
  damages.push_back({paths, description, [](const std::string& text) { return text.substr(0, 20); }, none});
  damages.push_back(
      {paths, description, replace(R"("Simulated": true)", R"("Simulated": false, "Simulated": 0)"), none});
  return damages;
}

TEST(DamagedStudy, IsRefusedWithItsFileAndLine) {
  for (const auto& damages : {damages_of_trials(), damages_of_ratings(), damages_of_lists(), damages_of_description()})
    for (const Damage& damage : damages) {
      const TemporaryFolder folder;
      const fs::path study = folder / "data";
      write_study(study, damage.design);
      put_bytes(study / damage.file, damage.change(bytes_of(study / damage.file)));
      SCOPED_TRACE(damage.message);
      expect_error(ErrorKind::bad_input, (study / damage.file).string() + damage.message,
                   [&] { analyse_study(read_study(study)); });
    }
}

/// Descriptions of columns are for people and other programs; the names of what they describe lie in the design.
TEST(DamagedStudy, DescriptionsOfColumnsDoNotMatter) {
  const TemporaryFolder folder;
  const fs::path study = folder / "data";
  write_study(study, path_design());
  const StudyData before = read_study(study);
  const std::string page = analysis_page(before, analyse_study(before));
  for (const char* file : {"task-paths_beh.json", "participants.json", "phenotype/questionnaire.json", "README"})
    for (const char* text : {"", "{", "[]", "{\"Simulated\": false}", "\xff\xfe", "null"}) {
      put_bytes(study / file, text);
      const StudyData after = read_study(study);
      EXPECT_EQ(analysis_page(after, analyse_study(after)), page) << file << ' ' << text;
    }
}

TEST(DamagedStudy, AFolderInPlaceOfAFileIsRefused) {
  for (const char* file : {table, participants, questionnaire, description, "code/design.toml"}) {
    const TemporaryFolder folder;
    const fs::path study = folder / "data";
    write_study(study, path_design());
    fs::remove(study / file);
    fs::create_directory(study / file);
    expect_error(ErrorKind::bad_input, (study / file).string() + ": is a folder", [&] { read_study(study); });
  }
}

TEST(DamagedStudy, ALinkThatLeadsNowhereIsRefused) {
  for (const char* file : {table, participants, questionnaire, description, "code/design.toml"}) {
    const TemporaryFolder folder;
    const fs::path study = folder / "data";
    write_study(study, path_design());
    fs::remove(study / file);
    fs::create_symlink((study / file).filename(), study / file);
    expect_error(ErrorKind::bad_input, (study / file).string() + ": cannot be opened", [&] { read_study(study); });
  }
}

TEST(EditedStudy, WindowsLineEndsAndAByteOrderMarkAreRead) {
  const TemporaryFolder folder;
  const fs::path study = folder / "data";
  write_study(study, path_design());
  const StudyData before = read_study(study);
  for (const char* file : {table, participants, questionnaire, description, "code/design.toml"})
    put_bytes(study / file, "\xef\xbb\xbf" + with_windows_ends(bytes_of(study / file)));
  const StudyData after = read_study(study);
  ASSERT_EQ(after.subjects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.subjects[i].trials.size(), before.subjects[i].trials.size());
    EXPECT_EQ(after.subjects[i].answers, before.subjects[i].answers);
  }
  EXPECT_EQ(analysis_page(after, analyse_study(after)), analysis_page(before, analyse_study(before)));
  EXPECT_NO_THROW(StudyFolder(study, path_design(), true)) << "the design means the same";
}

TEST(EditedStudy, ColumnsOfOthersAreKept) {
  const TemporaryFolder folder;
  const fs::path study = folder / "data";
  write_study(study, path_design());
  put_bytes(study / participants, "participant_id\tage\tobserver\nsub-02\t31\tsimulated\nsub-01\t47\tsimulated\n");
  const StudyFolder opened(study, path_design(), true);
  opened.add_participant(0);
  write_subject(opened, simulate_subject(path_design(), {}, 2, 1));
  EXPECT_EQ(bytes_of(study / participants),
            "participant_id\tage\tobserver\nsub-02\t31\tsimulated\nsub-01\t47\tsimulated\nsub-03\tn/a\tsimulated\n");
  EXPECT_EQ(read_study(study).subjects.size(), 3u);
}

TEST(EditedStudy, ALastLineWithoutItsEndIsRead) {
  const TemporaryFolder folder;
  const fs::path study = folder / "data";
  write_study(study, path_design());
  const std::string whole = bytes_of(study / table);
  put_bytes(study / table, whole.substr(0, whole.size() - 1));
  EXPECT_EQ(read_study(study).subjects.at(0).trials.size(), 4u);
  put_bytes(study / table, whole.substr(0, whole.size() - 3));
  EXPECT_EQ(read_study(study).subjects.at(0).trials.size(), 3u) << "half-written as the machine died";
}

TEST(EditedStudy, SubjectsWithoutTrialsDoNotCountAndAreNamed) {
  const TemporaryFolder folder;
  const fs::path study = folder / "data";
  write_study(study, path_design());
  StudyFolder(study, path_design(), true).add_participant(2);
  fs::remove(study / "sub-02/beh/sub-02_task-paths_beh.tsv");
  const StudyAnalysis analysis = analyse_study(read_study(study));
  EXPECT_EQ(analysis.subjects, 1);
  EXPECT_THAT(analysis.without_trials, ElementsAre("sub-02", "sub-03"));
  EXPECT_THAT(analysis_page(read_study(study), analysis), HasSubstr("Without trials: sub-02, sub-03."));
}

}  // namespace wheatstone::damage_test
