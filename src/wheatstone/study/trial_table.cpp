#include "wheatstone/study/trial_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "wheatstone/error.h"
#include "wheatstone/study/trial_plan.h"

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

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.emplace_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

/// Reads fields of one line in their order; a field that is not as expected is named.
class FieldReader {
 public:
  FieldReader(std::vector<std::string> fields, std::string where)
      : fields_(std::move(fields)), where_(std::move(where)) {}

  const std::string& at(std::size_t column) const { return fields_[column]; }
  double number(std::size_t column) const {
    if (at(column) == "n/a") return not_available;
    double value = 0;
    const auto [end, error] = std::from_chars(at(column).data(), at(column).data() + at(column).size(), value);
    if (error != std::errc() || end != at(column).data() + at(column).size()) refuse(column, "a number");
    return value;
  }
  int index_in(std::size_t column, const std::vector<std::string>& names, std::string_view what) const {
    const auto found = std::ranges::find(names, at(column));
    if (found == names.end()) refuse(column, what);
    return static_cast<int>(found - names.begin());
  }
  bool is_yes(std::size_t column) const {
    if (at(column) != "yes" && at(column) != "no") refuse(column, "yes or no");
    return at(column) == "yes";
  }
  [[noreturn]] void refuse(std::size_t column, std::string_view expected) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is not {}", where_, at(column), expected));
  }

 private:
  std::vector<std::string> fields_;
  std::string where_;
};

TrialRecord parse_row(const StudyDesign& design, const FieldReader& row, const std::vector<std::string>& conditions,
                      const std::vector<std::string>& items) {
  const std::size_t last = first_columns.size() + design.factors.size();
  TrialRecord record{.trial = static_cast<int>(row.number(3)),
                     .condition = row.index_in(0, conditions, "a condition of the design"),
                     .item = row.index_in(4, items, "an item of the design"),
                     .response_time_s = row.number(1),
                     .head_least_m = row.number(last + 3),
                     .head_most_m = row.number(last + 4),
                     .log_delay_s = row.number(last + 5)};
  record.response = design.task == StudyTask::rating ? static_cast<int>(row.number(last + 1))
                    : row.is_yes(last + 1)           ? 1
                                                     : 0;
  if (std::isnan(record.response_time_s)) row.refuse(1, "a response time");
  return record;
}

nlohmann::ordered_json column(std::string_view description, std::string_view units = "") {
  nlohmann::ordered_json json{{"Description", description}};
  if (!units.empty()) json["Units"] = units;
  return json;
}

}  // namespace

std::vector<std::string> fields_of(std::string_view line) { return split(line, '\t'); }

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

std::string trial_table_header(const StudyDesign& design) {
  std::string line;
  for (const std::string_view name : first_columns) line += fmt::format("{}\t", name);
  for (const StudyFactor& factor : design.factors) line += factor.name + "\t";
  for (const std::string_view name : last_columns)
    line += fmt::format("{}{}", name, name == last_columns.back() ? "\n" : "\t");
  return line;
}

std::string trial_table_row(const StudyDesign& design, int subject, const TrialRecord& record, bool simulated) {
  const StudyCondition condition =
      conditions_of_group(design, group_of_subject(design, subject))[static_cast<std::size_t>(record.condition)];
  std::string line =
      fmt::format("{}\t{}\t{}\t{}\t{}\t", condition.name, number_text(record.response_time_s),
                  stimulus_files(design, record.item, condition).front(), record.trial, item_name(design, record.item));
  for (const std::string& level : condition.levels) line += level + "\t";
  const std::optional<bool> correct = is_correct(design, record);
  const std::string expected = correct ? answer_text(design, is_connected(design, record.item) ? 1 : 0) : "n/a";
  return line + fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\n", expected, answer_text(design, record.response),
                            correct ? (*correct ? "true" : "false") : "n/a", number_text(record.head_least_m),
                            number_text(record.head_most_m), number_text(record.log_delay_s),
                            simulated ? "simulated" : "person");
}

std::vector<TrialRecord> parse_trial_table(const StudyDesign& design, int subject, std::string_view text,
                                           std::string_view name) {
  const std::string header = trial_table_header(design);
  if (!text.starts_with(header))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is of another design, expected the columns of {}", name, design.name));
  text.remove_prefix(header.size());
  text = text.substr(0, text.rfind('\n') + 1);
  std::vector<std::string> conditions, items;
  for (const StudyCondition& condition : conditions_of_group(design, group_of_subject(design, subject)))
    conditions.push_back(condition.name);
  for (int item = 0; item < design.item_count; ++item) items.push_back(item_name(design, item));
  const std::size_t columns = first_columns.size() + design.factors.size() + last_columns.size();
  std::vector<TrialRecord> records;
  for (const std::string& line : lines_of(text)) {
    const std::string where = fmt::format("{}:{}", name, records.size() + 2);
    std::vector<std::string> fields = fields_of(line);
    if (fields.size() != columns)
      throw Error(ErrorKind::bad_input, fmt::format("{}: has {} fields, expected {}", where, fields.size(), columns));
    records.push_back(parse_row(design, FieldReader(std::move(fields), where), conditions, items));
  }
  return records;
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
