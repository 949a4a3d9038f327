#include "wheatstone/study/study_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/trial_plan.h"
#include "wheatstone/study/trial_table.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_bytes = std::size_t{1} << 28;

fs::path description_file(const fs::path& folder) { return folder / "dataset_description.json"; }
fs::path design_file(const fs::path& folder) { return folder / "code" / "design.toml"; }
fs::path participants_file(const fs::path& folder) { return folder / "participants.tsv"; }
fs::path questionnaire_file(const fs::path& folder) { return folder / "phenotype" / "questionnaire.tsv"; }

std::string_view observer_text(bool simulated) { return simulated ? "simulated" : "person"; }

void make_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

Json observer_column() {
  return {
      {"Description", "Who answered"},
      {"Levels", {{"person", "a human subject"}, {"simulated", "answers drawn by lot by wheatstone study simulate"}}}};
}

std::string participants_sidecar(const StudyDesign& design, bool simulated) {
  Json json{{"Simulated", simulated}, {"participant_id", {{"Description", "Subject, by its row of the design"}}}};
  for (const StudyFactor& factor : design.factors)
    if (factor.between) json[factor.name] = {{"Description", "Level of the factor, which differs between subjects"}};
  json["observer"] = observer_column();
  return json.dump(2) + "\n";
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

/// A table's text with this line in place of the one that begins alike, or behind all.
std::string with_line(const std::string& text, const std::string& header, const std::string& line) {
  const std::string key = line.substr(0, line.find('\t') + 1);
  std::string table = header;
  bool replaced = false;
  for (const std::string& present : lines_of(text)) {
    if (present + "\n" == header) continue;
    const bool same = present.starts_with(key);
    table += (same ? line : present) + "\n";
    replaced |= same;
  }
  return replaced ? table : table + line + "\n";
}

void put_line(const fs::path& path, const std::string& header, const std::string& line) {
  make_folders(path.parent_path());
  write_whole_file(path, with_line(fs::exists(path) ? read_whole_file(path, most_bytes) : "", header, line));
}

/// The subjects of participants.tsv, by their numbers.
std::vector<int> participants(const fs::path& folder, const StudyDesign& design) {
  std::vector<int> subjects;
  if (!fs::exists(participants_file(folder))) return subjects;
  for (const std::string& line : lines_of(read_whole_file(participants_file(folder), most_bytes))) {
    const std::string id = fields_of(line).front();
    if (id == "participant_id") continue;
    int subject = 0;
    while (subject < 100'000 && id != "sub-" + subject_label(design, subject)) ++subject;
    if (subject == 100'000)
      throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is no subject, expected sub-01 and so on",
                                                    participants_file(folder).string(), id));
    subjects.push_back(subject);
  }
  return subjects;
}

bool is_simulated(const fs::path& folder) {
  const fs::path file = description_file(folder);
  try {
    return Json::parse(read_whole_file(file, most_bytes)).at("Simulated").get<bool>();
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: is no description of a study", file.string()));
  }
}

std::vector<std::pair<std::string, int>> answers_of(const fs::path& folder, const std::string& id) {
  std::vector<std::pair<std::string, int>> answers;
  if (!fs::exists(questionnaire_file(folder))) return answers;
  const std::vector<std::string> lines = lines_of(read_whole_file(questionnaire_file(folder), most_bytes));
  if (lines.empty()) return answers;
  const std::vector<std::string> names = fields_of(lines.front());
  for (const std::string& line : lines) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.front() != id) continue;
    for (std::size_t i = 1; i < std::min(fields.size(), names.size()); ++i)
      if (fields[i].size() == 1 && fields[i][0] >= '0' && fields[i][0] <= '9')
        answers.emplace_back(names[i], fields[i][0] - '0');
  }
  return answers;
}

}  // namespace

bool holds_study(const fs::path& folder) {
  if (fs::exists(description_file(folder))) return true;
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is not empty and holds no study", folder.string()));
  return false;
}

StudyFolder::StudyFolder(fs::path path, const StudyDesign& design, bool simulated)
    : path_(std::move(path)), design_(design), simulated_(simulated) {
  if (holds_study(path_))
    check_same();
  else
    begin();
}

void StudyFolder::check_same() const {
  if (read_whole_file(design_file(path_), most_bytes) != design_.toml)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: holds data of another design than {}, expected an empty folder or one of this design",
                            path_.string(), design_.name));
  if (is_simulated(path_) != simulated_)
    throw Error(ErrorKind::bad_input, fmt::format("{}: holds data of {}, which are never mixed with those of {}",
                                                  path_.string(), simulated_ ? "people" : "simulated observers",
                                                  simulated_ ? "simulated observers" : "people"));
}

void StudyFolder::begin() const {
  make_folders(path_ / "code");
  make_folders(stimuli());
  write_whole_file(design_file(path_), design_.toml);
  write_whole_file(path_ / fmt::format("task-{}_beh.json", design_.task_label),
                   trial_table_sidecar(design_, simulated_));
  write_whole_file(path_ / "participants.json", participants_sidecar(design_, simulated_));
  write_whole_file(path_ / "README",
                   fmt::format("{}\n\n{}The design lies in code/design.toml.\n", design_.title,
                               simulated_ ? "SIMULATED: no person took part; all answers were drawn by lot.\n" : ""));
  // The description comes last: a folder with it is whole.
  const Json description{{"Name", design_.title},
                         {"BIDSVersion", "1.9.0"},
                         {"DatasetType", "raw"},
                         {"Simulated", simulated_},
                         {"GeneratedBy", Json::array({{{"Name", "Wheatstone"}}})}};
  write_whole_file(description_file(path_), description.dump(2) + "\n");
}

void StudyFolder::make_stimuli(const StudyScreen& screen) const {
  const auto need = [&](int item, const StudyCondition& condition) {
    for (const std::string& name : stimulus_files(design_, item, condition)) {
      const fs::path file = stimuli() / name;
      if (fs::exists(file)) continue;
      if (!design_.items.empty())
        throw Error(ErrorKind::bad_input, fmt::format("{}: this stimulus is missing", file.string()));
      make_folders(file.parent_path());
      write_whole_file(file, graph_json(graph_of_item(design_, item, condition.shown, screen)));
    }
  };
  const int items = design_.item_count + (design_.items.empty() ? design_.practice : 0);
  for (int group = 0; group < group_count(design_); ++group)
    for (const StudyCondition& condition : conditions_of_group(design_, group))
      for (int item = 0; item < items; ++item) need(item, condition);
}

void StudyFolder::add_participant(int subject) const {
  std::string header = "participant_id\t", line = fmt::format("sub-{}\t", subject_label(design_, subject));
  const StudyCondition condition = conditions_of_group(design_, group_of_subject(design_, subject)).front();
  for (std::size_t i = 0; i < design_.factors.size(); ++i)
    if (design_.factors[i].between) {
      header += design_.factors[i].name + "\t";
      line += condition.levels[i] + "\t";
    }
  put_line(participants_file(path_), header + "observer\n", line + std::string(observer_text(simulated_)));
  make_folders(trial_table(subject).parent_path());
  make_folders(head_path(subject).parent_path());
}

fs::path StudyFolder::trial_table(int subject) const {
  const std::string label = subject_label(design_, subject);
  return path_ / fmt::format("sub-{}", label) / "beh" /
         fmt::format("sub-{}_task-{}_beh.tsv", label, design_.task_label);
}

fs::path StudyFolder::head_path(int subject) const {
  return path_ / "sourcedata" /
         fmt::format("sub-{}_task-{}_head.tsv", subject_label(design_, subject), design_.task_label);
}

void StudyFolder::write_answers(const SubjectRecords& subject) const {
  if (design_.questions.empty()) return;
  std::string header = "participant_id\t", line = fmt::format("sub-{}\t", subject_label(design_, subject.number));
  for (const StudyQuestion& question : design_.questions) {
    const auto answer = std::ranges::find(subject.answers, question.name, &std::pair<std::string, int>::first);
    header += question.name + "\t";
    line += answer == subject.answers.end() ? "n/a\t" : fmt::format("{}\t", answer->second);
  }
  put_line(questionnaire_file(path_), header + "observer\n", line + std::string(observer_text(simulated_)));
  write_whole_file(path_ / "phenotype" / "questionnaire.json", questionnaire_sidecar(design_, simulated_));
}

SubjectRecords read_subject(const StudyFolder& folder, int subject) {
  SubjectRecords records{.number = subject};
  const fs::path table = folder.trial_table(subject);
  if (!fs::exists(table)) return records;
  records.trials = parse_trial_table(folder.design(), subject, read_trial_log(table), table.string());
  records.answers = answers_of(folder.path(), "sub-" + subject_label(folder.design(), subject));
  return records;
}

void write_subject(const StudyFolder& folder, const SubjectRecords& subject) {
  folder.add_participant(subject.number);
  std::string table = trial_table_header(folder.design());
  for (const TrialRecord& record : subject.trials)
    table += trial_table_row(folder.design(), subject.number, record, folder.simulated());
  write_whole_file(folder.trial_table(subject.number), table);
  folder.write_answers(subject);
}

StudyData read_study(const fs::path& path) {
  if (!fs::exists(description_file(path)) || !fs::exists(design_file(path)))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no study, expected the folder of wheatstone study run or simulate", path.string()));
  StudyData data{
      .design = parse_study_design(read_whole_file(design_file(path), most_bytes), design_file(path).string()),
      .simulated = is_simulated(path)};
  const StudyFolder folder(path, data.design, data.simulated);
  for (const int subject : participants(path, data.design)) data.subjects.push_back(read_subject(folder, subject));
  return data;
}

}  // namespace wheatstone
