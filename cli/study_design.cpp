#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "output_option.h"
#include "print_facts.h"
#include "study_kinds.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/study_design.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::cli {
namespace {

struct StudyDesignArguments {
  std::string design;
  std::string file;  ///< of the copy; empty: none is written
};

void print_json(const StudyDesign& design, const Session& session) {
  nlohmann::ordered_json conditions = nlohmann::ordered_json::array();
  for (const StudyCondition& condition : conditions_of_group(design, 0)) conditions.push_back(condition.name);
  nlohmann::ordered_json effects = nlohmann::ordered_json::array();
  for (const DesignEffect& effect : degrees_of_freedom(design))
    effects.push_back({{"effect", effect.name},
                       {"df", effect.effect},
                       {"df_error_subjects", effect.error_subjects},
                       {"df_error_items", effect.error_items}});
  const DesignBalance balance = count_balance(design);
  print_facts({{"name", design.name},
               {"subjects", design.subjects},
               {"groups", group_count(design)},
               {"conditions", conditions},
               {"trials", conditions.size() * static_cast<std::size_t>(design.repetitions)},
               {"items", design.item_count},
               {"order", order_text(design)},
               {"balanced", {{"positions", balance.positions}, {"follows", balance.follows}, {"items", balance.items}}},
               {"effects", effects}},
              session);
}

void print_text(const StudyDesign& design, const Session& session) {
  const auto conditions = conditions_of_group(design, 0);
  fmt::print(session.output, "{}: {}\n", design.name, design.title);
  fmt::print(session.output, "subjects: {}{}\n", design.subjects,
             group_count(design) > 1 ? fmt::format(" in {} groups", group_count(design)) : "");
  fmt::print(session.output, "conditions: {}\n", conditions.size());
  for (const StudyCondition& condition : conditions) fmt::print(session.output, "  {}\n", condition.name);
  fmt::print(session.output, "trials of a subject: {}, after {} for practice\nitems: {}\norder: {}\n",
             conditions.size() * static_cast<std::size_t>(design.repetitions), design.practice, design.item_count,
             order_text(design));
  const DesignBalance balance = count_balance(design);
  const auto say = [&](bool equal, std::string_view what) {
    fmt::print(session.output, "{}: {}\n", what, equal ? "equally often" : "not equally often");
  };
  say(balance.positions, "each condition at each place");
  say(balance.follows, "each condition behind each other one");
  say(balance.items, "each item in each condition");
  for (const DesignEffect& effect : degrees_of_freedom(design))
    fmt::print(session.output, "{}: F1({}, {}){}\n", effect.name, effect.effect, effect.error_subjects,
               effect.error_items > 0 ? fmt::format(", F2({}, {})", effect.effect, effect.error_items) : "");
}

void run_study_design(const StudyDesignArguments& arguments, const Session& session) {
  const StudyDesign design = load_study_design(arguments.design);
  if (!arguments.file.empty()) {
    check_not_an_input(arguments.file, {{arguments.design}});
    write_whole_file(arguments.file, design.toml);
  }
  if (session.json)
    print_json(design, session);
  else
    print_text(design, session);
}

}  // namespace

void add_study_design(CLI::App& study, const Session& session) {
  const auto arguments = std::make_shared<StudyDesignArguments>();
  CLI::App& command =
      *study.add_subcommand("design", "Check the design of an experiment, and show its order and balance");
  command.fallthrough();
  std::string names;
  for (const BuiltInDesign& built_in : built_in_designs()) names += fmt::format("{}, ", built_in.name);
  command.add_option("design", arguments->design, fmt::format("{}or a TOML file", names))
      ->required()
      ->type_name("NAME|FILE.toml");
  command.add_option("-o,--output", arguments->file, "Copy of the design, to be changed")
      ->type_name("FILE.toml")
      ->check(not_empty());
  command.footer(
      "Examples:\n"
      "  wheatstone study design path-searching-1\n"
      "  wheatstone study design path-searching-2 -o mine.toml && wheatstone study design mine.toml");
  command.callback([arguments, &session] { run_study_design(*arguments, session); });
}

}  // namespace wheatstone::cli
