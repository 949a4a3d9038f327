#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/settings_internal.h"
#include "wheatstone/study/study_design.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone {
namespace {

/// A table of the file, and its name in messages: "mine.toml: [texts]".
class Table {
 public:
  Table(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

  const std::string& where() const { return where_; }
  [[noreturn]] void refuse(std::string_view key, std::string_view expected) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}: expected {}", where_, key, expected));
  }
  const toml::node* find(std::string_view key) const { return table_.get(key); }

  void check_keys(std::initializer_list<std::string_view> known) const {
    for (const auto& entry : table_)
      if (std::ranges::find(known, entry.first.str()) == known.end())
        throw Error(ErrorKind::bad_input, fmt::format("{}: unknown key '{}'", where_, entry.first.str()));
  }

  void read(std::string_view key, std::string& value) const {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    const auto text = node->value_exact<std::string>();
    if (!text) refuse(key, "a text");
    value = *text;
  }

  template <class Number>
  void read(std::string_view key, Number& value, std::int64_t least, std::int64_t most) const {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    const auto number = node->value_exact<std::int64_t>();
    if (!number || *number < least || *number > most)
      refuse(key, fmt::format("a whole number from {} to {}", least, most));
    value = static_cast<Number>(*number);
  }

  void read(std::string_view key, bool& value) const {
    const toml::node* const node = find(key);
    if (node == nullptr) return;
    const auto truth = node->value_exact<bool>();
    if (!truth) refuse(key, "true or false");
    value = *truth;
  }

  template <class Value, std::size_t count>
  void read_choice(std::string_view key, Value& value,
                   const std::array<std::pair<std::string_view, Value>, count>& names) const {
    std::string text, all;
    read(key, text);
    if (find(key) == nullptr) return;
    for (const auto& [name, choice] : names) {
      if (name == text) {
        value = choice;
        return;
      }
      all += fmt::format("{}'{}'", all.empty() ? "" : " or ", name);
    }
    refuse(key, all);
  }

  /// The tables of [[key]], and what each is called in messages.
  std::vector<Table> tables(std::string_view key) const {
    std::vector<Table> all;
    const toml::node* const node = find(key);
    if (node == nullptr) return all;
    const toml::array* const list = node->as_array();
    if (list == nullptr || !list->is_homogeneous<toml::table>()) refuse(key, fmt::format("tables [[{}]]", key));
    for (const toml::node& entry : *list) all.emplace_back(*entry.as_table(), fmt::format("{}: [[{}]]", where_, key));
    return all;
  }

  Table table(std::string_view key) const {
    static const toml::table nothing;
    const toml::node* const node = find(key);
    if (node != nullptr && !node->is_table()) refuse(key, fmt::format("a table [{}]", key));
    return {node == nullptr ? nothing : *node->as_table(), fmt::format("{}: [{}]", where_, key)};
  }

  auto begin() const { return table_.begin(); }
  auto end() const { return table_.end(); }

 private:
  const toml::table& table_;
  std::string where_;
};

/// A number, text or truth as a word; empty for anything else.
std::string word_of(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto whole = node.value_exact<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  return {};
}

/// A name that may stand in a column of a table and in a file's name.
void check_name(const Table& table, std::string_view key, const std::string& name) {
  const auto is_fine = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c >= 0x80;
  };
  if (name.empty() || name == "n/a" || !std::ranges::all_of(name, is_fine))
    table.refuse(key, "letters, digits, '_', '-' and '.'");
}

/// A text that may stand in a field of a table.
void check_text(const Table& table, std::string_view key, const std::string& text) {
  if (text.empty() || text == "n/a" || std::ranges::any_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    table.refuse(key, "names without control characters");
}

/// Names of which each is to be told apart from all others, and from columns that the tables have anyway.
void check_told_apart(const std::vector<Table>& tables, const std::vector<std::string>& names,
                      std::initializer_list<std::string_view> columns) {
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::find(columns, names[i]) != columns.end())
      tables[i].refuse("name", fmt::format("another name: '{}' is a column of the tables", names[i]));
    if (!known.insert(names[i]).second) tables[i].refuse("name", fmt::format("'{}' once only", names[i]));
  }
}

/// Reads each table of a list.
template <class Value, class Read>
void read_all(const std::vector<Table>& tables, std::vector<Value>& values, Read read,
              std::initializer_list<std::string_view> columns) {
  std::vector<std::string> names;
  for (const Table& table : tables) {
    values.push_back(read(table));
    names.push_back(values.back().name);
  }
  check_told_apart(tables, names, columns);
}

/// A level or a control condition that is a table: its name and what it sets.
FactorLevel named_level(const Table& table) {
  FactorLevel level;
  table.read("name", level.name);
  check_name(table, "name", level.name);
  ShownSettings tried;
  for (const auto& [key, node] : table) {
    if (key == "name") continue;
    level.sets.emplace_back(key.str(), word_of(node));
    apply_setting(key.str(), level.sets.back().second, tried, table.where());
  }
  return level;
}

StudyFactor read_factor(const Table& table) {
  StudyFactor factor;
  table.check_keys({"name", "between", "levels"});
  table.read("name", factor.name);
  check_name(table, "name", factor.name);
  table.read("between", factor.between);
  const toml::node* const levels = table.find("levels");
  if (levels == nullptr || !levels->is_array() || levels->as_array()->size() < 2)
    table.refuse("levels", "a list of at least two");
  for (const toml::node& node : *levels->as_array()) {
    if (const toml::table* const named = node.as_table()) {
      factor.levels.push_back(named_level({*named, table.where()}));
    } else {
      FactorLevel level{.name = word_of(node)};
      check_name(table, "levels", level.name);
      if (is_setting(factor.name)) {
        ShownSettings tried;
        apply_setting(factor.name, level.name, tried, table.where());
        level.sets.emplace_back(factor.name, level.name);
      }
      factor.levels.push_back(level);
    }
  }
  std::set<std::string> names;
  for (const FactorLevel& level : factor.levels)
    if (!names.insert(level.name).second) table.refuse("levels", fmt::format("'{}' once only", level.name));
  return factor;
}

StudyQuestion read_question(const Table& table) {
  StudyQuestion question;
  table.check_keys({"name", "text", "least", "most", "least_means", "most_means"});
  table.read("name", question.name);
  check_name(table, "name", question.name);
  table.read("text", question.text);
  table.read("least", question.least, 0, 9);
  table.read("most", question.most, 0, 9);
  table.read("least_means", question.least_means);
  table.read("most_means", question.most_means);
  if (question.most <= question.least) table.refuse("most", "more than least");
  return question;
}

void read_texts(const Table& table, StudyTexts& texts) {
  table.check_keys({"instruction", "question", "yes", "no", "practice_ends", "pause", "thanks"});
  table.read("instruction", texts.instruction);
  table.read("question", texts.question);
  table.read("yes", texts.yes);
  table.read("no", texts.no);
  table.read("practice_ends", texts.practice_ends);
  table.read("pause", texts.pause);
  table.read("thanks", texts.thanks);
}

void read_pictures(const Table& table, StudyDesign& design) {
  table.check_keys({"items", "left", "right", "scale_least", "scale_most"});
  table.read("left", design.left);
  table.read("right", design.right);
  table.read("scale_least", design.scale_least, 0, 9);
  table.read("scale_most", design.scale_most, 0, 9);
  if (design.scale_most <= design.scale_least) table.refuse("scale_most", "more than scale_least");
  const toml::node* const items = table.find("items");
  if (items == nullptr) return;
  if (!items->is_array()) table.refuse("items", "a list of names");
  std::set<std::string> names;
  for (const toml::node& node : *items->as_array()) {
    design.items.push_back(word_of(node));
    check_text(table, "items", design.items.back());
    if (!names.insert(design.items.back()).second)
      table.refuse("items", fmt::format("'{}' once only", design.items.back()));
  }
  for (const auto& [key, pattern] : {std::pair{"left", &design.left}, std::pair{"right", &design.right}})
    if (!pattern->empty()) check_text(table, key, *pattern);
  design.item_count = static_cast<int>(design.items.size());
  if (design.items.empty() || design.left.empty()) table.refuse("left", "a pattern such as \"{item}_left.png\"");
}

void read_numbers(const Table& table, StudyDesign& design) {
  static constexpr std::array<std::pair<std::string_view, StudyTask>, 2> tasks{
      {{"path", StudyTask::path}, {"rating", StudyTask::rating}}};
  static constexpr std::array<std::pair<std::string_view, TrialOrder>, 4> orders{{{"balanced", TrialOrder::balanced},
                                                                                  {"williams", TrialOrder::williams},
                                                                                  {"latin", TrialOrder::latin},
                                                                                  {"random", TrialOrder::random}}};
  static constexpr std::array<std::pair<std::string_view, TrialArrangement>, 2> arrangements{
      {{"rounds", TrialArrangement::rounds}, {"blocks", TrialArrangement::blocks}}};
  table.read_choice("task", design.task, tasks);
  table.read_choice("order", design.order, orders);
  table.read_choice("arrangement", design.arrangement, arrangements);
  table.read("subjects", design.subjects, 1, 10'000);
  table.read("repetitions", design.repetitions, 1, 1000);
  table.read("items", design.item_count, 1, 100'000);
  table.read("practice", design.practice, 0, 1000);
  table.read("break_every", design.break_every, 0, 100'000);
  table.read("seed", design.seed, 0, std::numeric_limits<std::int64_t>::max());
}

/// [published.MEASURE], in which "CONDITION" = [mean, standard deviation].
void read_published(const Table& table, StudyDesign& design) {
  table.check_keys({"response_time", "percent_correct", "rating"});
  for (const auto& [measure, node] : table) {
    const Table of_measure = table.table(measure.str());
    for (const auto& [condition, pair] : of_measure) {
      const toml::array* const numbers = pair.as_array();
      const auto number = [&](std::size_t i) { return numbers->get(i)->value<double>(); };
      if (numbers == nullptr || numbers->size() != 2 || !number(0) || !(number(1).value_or(0) > 0))
        of_measure.refuse(condition.str(), "[mean, standard deviation], two numbers, the second above 0");
      design.published.push_back({std::string(measure.str()), std::string(condition.str()), *number(0), *number(1)});
    }
  }
}

/// Published conditions are those of the design.
void check_published(const Table& table, const StudyDesign& design) {
  if (group_count(design) > 1) return;  // names of conditions have the group's level before them
  const std::vector<StudyCondition> conditions = conditions_of_group(design, 0);
  for (const PublishedMean& mean : design.published)
    if (std::ranges::find(conditions, mean.condition, &StudyCondition::name) == conditions.end())
      table.refuse(mean.condition, fmt::format("a condition of the design, as '{}'", conditions.front().name));
}

/// Numbers of levels and trials that a person could meet.
void check_size(const Table& table, const StudyDesign& design) {
  constexpr std::size_t most_conditions = 1000, most_trials = 10'000;
  std::size_t conditions = 1;
  for (const StudyFactor& factor : design.factors)
    conditions = std::min(conditions * factor.levels.size(), std::size_t{1} << 20);
  conditions += design.controls.size();
  if (conditions > most_conditions)
    table.refuse("factor", fmt::format("fewer levels: they make {} conditions, expected at most {}", conditions,
                                       most_conditions));
  if (conditions * static_cast<std::size_t>(design.repetitions) > most_trials)
    table.refuse("repetitions", fmt::format("at most {} trials of a subject", most_trials));
}

/// What must be there, and what must fit together.
void check_whole(const Table& table, const StudyDesign& design) {
  check_name(table, "name", design.name);
  if (design.task_label.empty() ||
      !std::ranges::all_of(design.task_label, [](unsigned char c) { return std::isalnum(c) != 0; }))
    table.refuse("task_label", "letters and digits only");
  if (design.subjects == 0) table.refuse("subjects", "their number");
  if (design.repetitions == 0) table.refuse("repetitions", "the number of trials in each condition");
  if (design.factors.empty()) table.refuse("factor", "at least one [[factor]]");
  if (design.task == StudyTask::rating && design.items.empty()) table.refuse("pictures", "[pictures] for a rating");
  const int trials = condition_count(design) * design.repetitions;
  if (design.item_count < trials)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: {} trials need as many items, which are met once each, and there are {}",
                            table.where(), trials, design.item_count));
}

}  // namespace

StudyDesign parse_study_design(std::string_view toml, std::string_view name) {
  StudyDesign design;
  design.toml = toml;
  try {
    const toml::table document = toml::parse(toml);
    const Table table(document, std::string(name));
    table.check_keys({"name", "title", "task_label", "task", "subjects", "repetitions", "items", "order", "arrangement",
                      "practice", "break_every", "seed", "shown", "factor", "control", "question", "texts", "pictures",
                      "published"});
    table.read("name", design.name);
    table.read("title", design.title);
    table.read("task_label", design.task_label);
    read_numbers(table, design);
    const Table shown = table.table("shown");
    for (const auto& [key, node] : shown) apply_setting(key.str(), word_of(node), design.shown, shown.where());
    read_all(table.tables("factor"), design.factors, read_factor,
             {"trial_type", "response_time", "stim_file", "trial", "item", "expected", "response", "correct",
              "head_least", "head_most", "log_delay", "observer", "participant_id"});
    read_all(table.tables("control"), design.controls, named_level, {});
    read_all(table.tables("question"), design.questions, read_question, {"participant_id", "observer"});
    read_texts(table.table("texts"), design.texts);
    read_pictures(table.table("pictures"), design);
    check_size(table, design);
    if (design.item_count == 0 && !design.factors.empty())
      design.item_count = condition_count(design) * design.repetitions;
    check_whole(table, design);
    const Table published = table.table("published");
    read_published(published, design);
    check_published(published, design);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}:{}: is no TOML: {}", name, error.source().begin.line, error.description()));
  }
  check_balance(design, name);
  return design;
}

StudyDesign load_study_design(const std::string& name_or_path) {
  for (const BuiltInDesign& built_in : built_in_designs())
    if (built_in.name == name_or_path) return parse_study_design(built_in.toml, built_in.name);
  if (!name_or_path.ends_with(".toml")) {
    std::string names;
    for (const BuiltInDesign& built_in : built_in_designs()) names += fmt::format("{}, ", built_in.name);
    throw Error(ErrorKind::wrong_usage,
                fmt::format("'{}' is no design, expected {}or a file NAME.toml", name_or_path, names));
  }
  constexpr std::size_t most_bytes = 1 << 20;
  return parse_study_design(read_whole_file(name_or_path, most_bytes), name_or_path);
}

}  // namespace wheatstone
