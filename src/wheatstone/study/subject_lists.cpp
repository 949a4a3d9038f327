#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ranges>
#include <set>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/file_lock.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/subject_lists_internal.h"
#include "wheatstone/study/trial_plan.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_list_bytes = std::size_t{1} << 28;

fs::path participants_file(const StudyFolder& folder) { return folder.path() / "participants.tsv"; }
fs::path questionnaire_file(const StudyFolder& folder) { return folder.path() / "phenotype" / "questionnaire.tsv"; }

std::string subject_id(const StudyDesign& design, int subject) { return "sub-" + subject_label(design, subject); }

std::string_view observer_text(bool simulated) { return simulated ? "simulated" : "person"; }

Json observer_column() {
  return {
      {"Description", "Who answered"},
      {"Levels", {{"person", "a human subject"}, {"simulated", "answers drawn by lot by wheatstone study simulate"}}}};
}

std::string questionnaire_sidecar(const StudyDesign& design, bool simulated) {
  Json json{{"MeasurementToolMetadata", {{"Description", "Questions at the end of a session"}}},
            {"Simulated", simulated}};
  for (const StudyQuestion& question : design.questions)
    json[question.name] = {{"Description", question.text},
                           {"Levels",
                            {{fmt::format("{}", question.least), question.least_means},
                             {fmt::format("{}", question.most), question.most_means}}}};
  json["observer"] = observer_column();
  return json.dump(2) + "\n";
}

/// Columns of a subject's row, and their values; the first is its id.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// Writes a subject's row of a table that several sessions share. Columns and rows of others are kept.
void put_row(const StudyFolder& folder, const fs::path& file, const Fields& fields, bool replaces) {
  make_study_folders(file.parent_path());
  FileLock lock;
  if (const std::error_code error = lock.hold(folder.design_file(), true))
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot be written: {}", folder.design_file().string(), error.message()));
  TsvTable table{.name = file.string()};
  if (is_there(file))
    table = parse_tsv(read_whole_file(file, most_list_bytes), file.string());
  else
    for (const auto& [column, value] : fields) table.columns.push_back(column);
  const std::size_t key = table.at(fields.front().first);
  auto row = std::ranges::find(table.rows, fields.front().second, [key](const auto& present) { return present[key]; });
  if (row != table.rows.end() && !replaces) return;
  if (row == table.rows.end()) row = table.rows.emplace(row, table.columns.size(), "n/a");
  for (const auto& [column, value] : fields) (*row)[table.at(column)] = value;
  write_whole_file(file, tsv_text(table));
}

void check_observer(const StudyFolder& folder, const TsvTable& table, std::size_t row) {
  const std::size_t column = table.at("observer");
  const std::string_view expected = observer_text(folder.simulated());
  if (table.rows[row][column] != expected) table.refuse(row, column, fmt::format("'{}'", expected));
}

/// "sub-01" as the subject's number, from 0 on; none for anything else.
std::optional<int> subject_of_id(const StudyDesign& design, const std::string& id) {
  if (!id.starts_with("sub-")) return {};
  const std::optional<int> number = whole_number_in(id.substr(4), 1, 100'000);
  if (!number || id != subject_id(design, *number - 1)) return {};
  return *number - 1;
}

/// The subject of each row of a table, each of which has one of its own.
std::vector<int> subjects_of_rows(const StudyFolder& folder, const TsvTable& table) {
  const std::size_t key = table.at("participant_id");
  std::vector<int> subjects;
  std::set<int> present;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& id = table.rows[row][key];
    const std::optional<int> subject = subject_of_id(folder.design(), id);
    if (!subject)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: '{}' is no subject, expected sub-01 and so on", table.where(row), id));
    if (!present.insert(*subject).second)
      throw Error(ErrorKind::bad_input, fmt::format("{}: {} stands there twice", table.where(row), id));
    check_observer(folder, table, row);
    subjects.push_back(*subject);
  }
  return subjects;
}

/// A subject's levels of the factors between subjects, by their names.
Fields levels_between(const StudyDesign& design, int subject) {
  Fields levels;
  std::size_t rest = static_cast<std::size_t>(group_of_subject(design, subject));
  for (auto factor = design.factors.rbegin(); factor != design.factors.rend(); ++factor) {
    if (!factor->between) continue;
    levels.emplace(levels.begin(), factor->name, factor->levels[rest % factor->levels.size()].name);
    rest /= factor->levels.size();
  }
  return levels;
}

/// Folders of subjects that are not listed.
void check_listed(const StudyFolder& folder, const std::vector<int>& subjects) {
  std::set<std::string> listed;
  for (const int subject : subjects) listed.insert(subject_id(folder.design(), subject));
  std::set<std::string> missing;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path(), error))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("sub-") && entry.is_directory(error) && !listed.contains(name))
      missing.insert(name);
  if (!missing.empty())
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} is missing, whose folder is there",
                                                  participants_file(folder).string(), *missing.begin()));
}

}  // namespace

std::string participants_sidecar(const StudyDesign& design, bool simulated) {
  Json json{{"Simulated", simulated}, {"participant_id", {{"Description", "Subject, by its row of the design"}}}};
  for (const StudyFactor& factor : design.factors)
    if (factor.between) json[factor.name] = {{"Description", "Level of the factor, which differs between subjects"}};
  json["observer"] = observer_column();
  return json.dump(2) + "\n";
}

std::vector<int> read_participants(const StudyFolder& folder) {
  const fs::path file = participants_file(folder);
  std::vector<int> subjects;
  if (is_there(file)) {
    const TsvTable table = parse_tsv(read_whole_file(file, most_list_bytes), file.string());
    subjects = subjects_of_rows(folder, table);
    for (std::size_t row = 0; row < subjects.size(); ++row)
      for (const auto& [factor, level] : levels_between(folder.design(), subjects[row]))
        if (const std::size_t column = table.at(factor); table.rows[row][column] != level)
          table.refuse(row, column, fmt::format("'{}'", level));
  }
  check_listed(folder, subjects);
  return subjects;
}

std::map<int, Answers> read_answers(const StudyFolder& folder, const std::vector<int>& listed) {
  const fs::path file = questionnaire_file(folder);
  std::map<int, Answers> answers;
  if (folder.design().questions.empty() || !is_there(file)) return answers;
  const TsvTable table = parse_tsv(read_whole_file(file, most_list_bytes), file.string());
  const std::vector<int> subjects = subjects_of_rows(folder, table);
  for (std::size_t row = 0; row < subjects.size(); ++row) {
    if (std::ranges::find(listed, subjects[row]) == listed.end())
      throw Error(ErrorKind::bad_input, fmt::format("{}: {} is not in participants.tsv", table.where(row),
                                                    subject_id(folder.design(), subjects[row])));
    for (const StudyQuestion& question : folder.design().questions) {
      const std::size_t column = table.at(question.name);
      if (table.rows[row][column] == "n/a") continue;
      const std::optional<int> answer = whole_number_in(table.rows[row][column], question.least, question.most);
      if (!answer)
        table.refuse(row, column, fmt::format("a whole number from {} to {}", question.least, question.most));
      answers[subjects[row]].emplace_back(question.name, *answer);
    }
  }
  return answers;
}

void list_participant(const StudyFolder& folder, int subject) {
  Fields fields{{"participant_id", subject_id(folder.design(), subject)}};
  for (const auto& level : levels_between(folder.design(), subject)) fields.push_back(level);
  fields.emplace_back("observer", observer_text(folder.simulated()));
  put_row(folder, participants_file(folder), fields, false);
}

void list_answers(const StudyFolder& folder, const SubjectRecords& subject) {
  const StudyDesign& design = folder.design();
  Fields fields{{"participant_id", subject_id(design, subject.number)}};
  for (const StudyQuestion& question : design.questions) {
    const auto answer = std::ranges::find(subject.answers, question.name, &std::pair<std::string, int>::first);
    fields.emplace_back(question.name, answer == subject.answers.end() ? "n/a" : fmt::format("{}", answer->second));
  }
  fields.emplace_back("observer", observer_text(folder.simulated()));
  put_row(folder, questionnaire_file(folder), fields, true);
  write_whole_file(questionnaire_file(folder).replace_extension(".json"),
                   questionnaire_sidecar(design, folder.simulated()));
}

}  // namespace wheatstone
