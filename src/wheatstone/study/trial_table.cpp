#include "wheatstone/study/trial_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "wheatstone/error.h"
#include "wheatstone/study/trial_plan.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone {
namespace {

/// Columns that stand before and behind those of the factors.
constexpr std::array<std::string_view, 5> first_columns{"trial_type", "response_time", "stim_file", "trial", "item"};
constexpr std::array<std::string_view, 7> last_columns{"expected",  "response",  "correct", "head_least",
                                                       "head_most", "log_delay", "observer"};

std::string number_text(double value) { return std::isnan(value) ? "n/a" : fmt::format("{:.6f}", value); }

std::string answer_text(const StudyDesign& design, int answer) {
  if (design.task == StudyTask::rating) return fmt::format("{}", answer);
  return answer == 1 ? "yes" : "no";
}

/// The fields of a trial of a subject who meets these conditions.
std::vector<std::string> fields_of_trial(const StudyDesign& design, const std::vector<StudyCondition>& conditions,
                                         const TrialRecord& record, bool simulated) {
  const StudyCondition& condition = conditions[static_cast<std::size_t>(record.condition)];
  std::vector<std::string> fields{condition.name, number_text(record.response_time_s),
                                  stimulus_files(design, record.item, condition).front(),
                                  fmt::format("{}", record.trial), item_name(design, record.item)};
  fields.insert(fields.end(), condition.levels.begin(), condition.levels.end());
  const std::optional<bool> correct = is_correct(design, record);
  fields.insert(fields.end(), {correct ? answer_text(design, is_connected(design, record.item) ? 1 : 0) : "n/a",
                               answer_text(design, record.response), correct ? (*correct ? "true" : "false") : "n/a",
                               number_text(record.head_least_m), number_text(record.head_most_m),
                               number_text(record.log_delay_s), simulated ? "simulated" : "person"});
  return fields;
}

/// Columns whose values do not follow from those of others.
struct OwnColumns {
  std::size_t condition, time, trial, item, response, head_least, head_most, log_delay;
};

/// Reads the rows of a table. A field that cannot be, alone or beside the others of its row, is named.
class RowReader {
 public:
  RowReader(const StudyDesign& design, int subject, bool simulated, TsvTable table)
      : design_(design),
        simulated_(simulated),
        table_(std::move(table)),
        conditions_(conditions_of_group(design, group_of_subject(design, subject))),
        own_{table_.at("trial_type"), table_.at("response_time"), table_.at("trial"),     table_.at("item"),
             table_.at("response"),   table_.at("head_least"),    table_.at("head_most"), table_.at("log_delay")} {
    for (int item = 0; item < design.item_count; ++item) items_.emplace(item_name(design, item), item);
  }

  std::vector<TrialRecord> read() const {
    std::vector<TrialRecord> records;
    std::set<int> trials, items;
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      records.push_back(read_row(row));
      if (!trials.insert(records.back().trial).second) refuse_twice(row, fmt::format("trial {}", records.back().trial));
      if (!items.insert(records.back().item).second) refuse_twice(row, table_.rows[row][own_.item]);
      check_what_follows(row, records.back());
    }
    return records;
  }

 private:
  TrialRecord read_row(std::size_t row) const {
    constexpr double longest_s = 86'400, farthest_m = 100;
    TrialRecord record{.trial = whole(row, own_.trial, 1, static_cast<int>(conditions_.size()) * design_.repetitions),
                       .condition = condition(row),
                       .item = item(row),
                       .response = response(row),
                       .response_time_s = number(row, own_.time, 0, longest_s),
                       .head_least_m = number_or_none(row, own_.head_least, -farthest_m, farthest_m),
                       .head_most_m = number_or_none(row, own_.head_most, -farthest_m, farthest_m),
                       .log_delay_s = number_or_none(row, own_.log_delay, 0, longest_s)};
    if (std::isnan(record.head_least_m) != std::isnan(record.head_most_m) || record.head_most_m < record.head_least_m)
      table_.refuse(row, own_.head_most, fmt::format("one behind head_least, '{}'", table_.rows[row][own_.head_least]));
    return record;
  }

  /// The values of the other columns.
  void check_what_follows(std::size_t row, const TrialRecord& record) const {
    const std::vector<std::string> fields = fields_of_trial(design_, conditions_, record, simulated_);
    for (std::size_t column = 0; column < fields.size(); ++column) {
      const bool is_number = column == own_.time || column == own_.trial || column == own_.response ||
                             column == own_.head_least || column == own_.head_most || column == own_.log_delay;
      if (!is_number && table_.rows[row][column] != fields[column])
        table_.refuse(row, column, fmt::format("'{}'", fields[column]));
    }
  }

  const std::string& at(std::size_t row, std::size_t column) const { return table_.rows[row][column]; }

  int whole(std::size_t row, std::size_t column, int least, int most) const {
    if (const auto value = whole_number_in(at(row, column), least, most)) return *value;
    table_.refuse(row, column, fmt::format("a whole number from {} to {}", least, most));
  }
  double number(std::size_t row, std::size_t column, double least, double most) const {
    if (const auto value = number_in(at(row, column), least, most)) return *value;
    table_.refuse(row, column, fmt::format("a number from {} to {}", least, most));
  }
  double number_or_none(std::size_t row, std::size_t column, double least, double most) const {
    return at(row, column) == "n/a" ? not_available : number(row, column, least, most);
  }
  int condition(std::size_t row) const {
    const auto found = std::ranges::find(conditions_, at(row, own_.condition), &StudyCondition::name);
    if (found == conditions_.end()) table_.refuse(row, own_.condition, "a condition of the design");
    return static_cast<int>(found - conditions_.begin());
  }
  int item(std::size_t row) const {
    const auto found = items_.find(at(row, own_.item));
    if (found == items_.end()) table_.refuse(row, own_.item, "an item of the design");
    return found->second;
  }
  int response(std::size_t row) const {
    if (design_.task == StudyTask::rating) return whole(row, own_.response, design_.scale_least, design_.scale_most);
    if (at(row, own_.response) != "yes" && at(row, own_.response) != "no")
      table_.refuse(row, own_.response, "yes or no");
    return at(row, own_.response) == "yes" ? 1 : 0;
  }
  [[noreturn]] void refuse_twice(std::size_t row, std::string_view what) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} stands there twice, expected once", table_.where(row), what));
  }

  const StudyDesign& design_;
  bool simulated_;
  TsvTable table_;
  std::vector<StudyCondition> conditions_;
  OwnColumns own_;
  std::map<std::string, int> items_;
};

nlohmann::ordered_json column(std::string_view description, std::string_view units = "") {
  nlohmann::ordered_json json{{"Description", description}};
  if (!units.empty()) json["Units"] = units;
  return json;
}

}  // namespace

std::string trial_table_header(const StudyDesign& design) {
  std::string line;
  for (const std::string_view name : first_columns) line += fmt::format("{}\t", name);
  for (const StudyFactor& factor : design.factors) line += factor.name + "\t";
  for (const std::string_view name : last_columns)
    line += fmt::format("{}{}", name, name == last_columns.back() ? "\n" : "\t");
  return line;
}

std::string trial_table_row(const StudyDesign& design, int subject, const TrialRecord& record, bool simulated) {
  const auto conditions = conditions_of_group(design, group_of_subject(design, subject));
  return fmt::format("{}\n", fmt::join(fields_of_trial(design, conditions, record, simulated), "\t"));
}

std::vector<TrialRecord> parse_trial_table(const StudyDesign& design, int subject, std::string_view text,
                                           std::string_view name, bool simulated) {
  TsvTable table = parse_tsv(text, std::string(name));
  const std::string header = trial_table_header(design);
  if (table.columns != fields_of(std::string_view(header).substr(0, header.size() - 1)))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}:1: is of another design, expected the columns of {}", name, design.name));
  return RowReader(design, subject, simulated, std::move(table)).read();
}

std::string trial_table_sidecar(const StudyDesign& design, bool simulated) {
  nlohmann::ordered_json json{{"TaskName", design.task_label},
                              {"TaskDescription", design.title},
                              {"Instructions", design.texts.instruction},
                              {"Simulated", simulated}};
  json["trial_type"] =
      column("Condition: the level of each factor within subjects, or the name of a control condition");
  json["response_time"] = column(
      "From the moment at which the screen had taken the stimulus' first frame (buffer swap) to the key. "
      "Precise to one frame of the screen",
      "s");
  json["stim_file"] = column("What was shown, below the folder stimuli; of a pair of pictures the left eye's");
  json["trial"] = column("Number of the trial of this subject, without practice, from 1 on");
  json["item"] = column("Graph or picture, which each subject meets once");
  for (const StudyFactor& factor : design.factors) {
    json[factor.name] = column("Level of the factor; n/a in a control condition");
    for (const FactorLevel& level : factor.levels) json[factor.name]["Levels"][level.name] = level.name;
  }
  json["expected"] = column("The right answer; n/a for ratings");
  json["response"] = column("The answer: yes, no, or a rating");
  json["correct"] = column("Whether the answer was right; n/a for ratings");
  json["head_least"] = column("Leftmost place of the head during the trial, to the right of the screen's middle", "m");
  json["head_most"] = column("Rightmost place of the head during the trial", "m");
  json["log_delay"] = column("From the key to the moment at which the program noted it", "s");
  json["observer"] = column("Who answered");
  json["observer"]["Levels"] = {{"person", "a human subject"},
                                {"simulated", "answers drawn by lot by wheatstone study simulate"}};
  return json.dump(2) + "\n";
}

}  // namespace wheatstone
