#include "wheatstone/study/study_folder.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/subject_lists_internal.h"
#include "wheatstone/study/trial_table.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_bytes = std::size_t{1} << 28;

fs::path description_file(const fs::path& folder) { return folder / "dataset_description.json"; }
fs::path design_file_of(const fs::path& folder) { return folder / "code" / "design.toml"; }

Json read_description(const fs::path& folder) {
  const fs::path file = description_file(folder);
  Json description = Json::parse(read_whole_file(file, most_bytes), nullptr, false);
  if (!description.is_object() || !description.value("Simulated", Json()).is_boolean())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no description of a study, expected one by Wheatstone", file.string()));
  return description;
}

/// By which simulation the data came about; empty where it does not say.
std::string simulation_of(const Json& description) {
  const Json simulation = description.value("Simulation", Json());
  return simulation.is_string() ? simulation.get<std::string>() : std::string();
}

/// Reads a subject, whose answers to the questions are these.
SubjectRecords read_trials(const StudyFolder& folder, int subject, const std::map<int, Answers>& answers) {
  SubjectRecords records{.number = subject};
  const fs::path table = folder.trial_table(subject);
  if (is_there(table))
    records.trials =
        parse_trial_table(folder.design(), subject, read_trial_log(table), table.string(), folder.simulated());
  if (const auto own = answers.find(subject); own != answers.end()) records.answers = own->second;
  return records;
}

}  // namespace

void make_study_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::symlink_status(file, error).type() != fs::file_type::not_found;
}

bool holds_study(const fs::path& folder) {
  std::error_code error;
  if (is_there(description_file(folder))) return true;
  if (!fs::exists(folder, error)) return false;
  if (!fs::is_directory(folder, error))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is a file, expected a folder", folder.string()));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename() != "stimuli")
      throw Error(ErrorKind::bad_input, fmt::format("{}: is not empty and holds no study", folder.string()));
  return false;
}

/// What of a design subjects meet: its lines without its published means, which may be added later.
std::string without_published(const std::string& toml) {
  std::string kept;
  bool is_published = false;
  std::istringstream lines(plain_text(toml));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) is_published = line.starts_with("[published");
    if (!is_published) kept += line + '\n';
  }
  kept.erase(kept.find_last_not_of('\n') + 1);
  return kept;
}

void check_study_folder(const fs::path& path, const StudyDesign& design, bool simulated, std::string_view simulation) {
  if (!holds_study(path)) return;
  if (without_published(read_whole_file(design_file_of(path), most_bytes)) != without_published(design.toml))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: holds data of another design than {}, expected an empty folder or one of this design",
                            path.string(), design.name));
  const Json description = read_description(path);
  if (description["Simulated"].get<bool>() != simulated)
    throw Error(ErrorKind::bad_input, fmt::format("{}: holds data of {}, which are never mixed with those of {}",
                                                  path.string(), simulated ? "people" : "simulated observers",
                                                  simulated ? "simulated observers" : "people"));
  if (const std::string present = simulation_of(description); present != simulation)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: holds another simulation ({}), expected an empty folder or the same simulation ({})",
                            path.string(), present.empty() ? "unknown" : present, simulation));
}

void check_stimuli(const fs::path& path, const StudyDesign& design) {
  if (design.items.empty()) return;
  for (int group = 0; group < group_count(design); ++group)
    for (const StudyCondition& condition : conditions_of_group(design, group))
      for (int item = 0; item < design.item_count; ++item)
        for (const std::string& name : stimulus_files(design, item, condition))
          if (std::error_code error; !fs::exists(path / "stimuli" / name, error))
            throw Error(ErrorKind::bad_input,
                        fmt::format("{}: this stimulus is missing", (path / "stimuli" / name).string()));
}

StudyFolder::StudyFolder(fs::path path, const StudyDesign& design, bool simulated, std::string_view simulation)
    : path_(std::move(path)), design_(design), simulated_(simulated) {
  check_study_folder(path_, design_, simulated_, simulation);
  if (!holds_study(path_)) begin(simulation);
}

void StudyFolder::begin(std::string_view simulation) const {
  make_study_folders(path_ / "code");
  write_whole_file(design_file(), design_.toml);
  write_whole_file(path_ / fmt::format("task-{}_beh.json", design_.task_label),
                   trial_table_sidecar(design_, simulated_));
  write_whole_file(path_ / "participants.json", participants_sidecar(design_, simulated_));
  write_whole_file(path_ / "README",
                   fmt::format("{}\n\n{}The design lies in code/design.toml.\n", design_.title,
                               simulated_ ? "SIMULATED: no person took part; all answers were drawn by lot.\n" : ""));
  // The description comes last: a folder with it is whole.
  Json description{{"Name", design_.title},
                   {"BIDSVersion", "1.9.0"},
                   {"DatasetType", "raw"},
                   {"Simulated", simulated_},
                   {"GeneratedBy", Json::array({{{"Name", "Wheatstone"}}})}};
  if (!simulation.empty()) description["Simulation"] = simulation;
  write_whole_file(description_file(path_), description.dump(2) + "\n");
}

void StudyFolder::make_stimuli(const StudyScreen& screen) const {
  check_stimuli(path_, design_);
  if (!design_.items.empty()) return;
  for (int group = 0; group < group_count(design_); ++group)
    for (const StudyCondition& condition : conditions_of_group(design_, group))
      for (int item = 0; item < design_.item_count + design_.practice; ++item) {
        const fs::path file = stimuli() / stimulus_files(design_, item, condition).front();
        if (fs::exists(file)) continue;
        make_study_folders(file.parent_path());
        write_whole_file(file, graph_json(graph_of_item(design_, item, condition.shown, screen)));
      }
}

void StudyFolder::add_participant(int subject) const {
  list_participant(*this, subject);
  make_study_folders(trial_table(subject).parent_path());
  make_study_folders(head_path(subject).parent_path());
}

fs::path StudyFolder::design_file() const { return design_file_of(path_); }

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
  if (!design_.questions.empty()) list_answers(*this, subject);
}

SubjectRecords read_subject(const StudyFolder& folder, int subject) {
  return read_trials(folder, subject, read_answers(folder, read_participants(folder)));
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
  if (!is_there(description_file(path)) || !is_there(design_file_of(path)))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is no study, expected the folder of wheatstone study run or simulate", path.string()));
  const Json description = read_description(path);
  StudyData data{
      .design = parse_study_design(read_whole_file(design_file_of(path), most_bytes), design_file_of(path).string()),
      .simulated = description["Simulated"].get<bool>()};
  const StudyFolder folder(path, data.design, data.simulated, simulation_of(description));
  const std::vector<int> subjects = read_participants(folder);
  const std::map<int, Answers> answers = read_answers(folder, subjects);
  for (const int subject : subjects) data.subjects.push_back(read_trials(folder, subject, answers));
  return data;
}

}  // namespace wheatstone
