#include <fmt/format.h>

#include <string>

#include "commands.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/study_design.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::cli {
namespace {

struct StudyDesignArguments {
  std::string design;
  std::string file;  ///< of the copy; empty: none is written
};

std::string text_of(const DesignBalance& balance) {
  const auto say = [](bool equal, const char* what) {
    return fmt::format("{}: {}", what, equal ? "equally often" : "not equally often");
  };
  return lines({}, {say(balance.positions, "each condition at each place"),
                    say(balance.follows, "each condition behind each other one"),
                    say(balance.items, "each item in each condition")});
}

Report run_study_design(const StudyDesignArguments& arguments, const Session& /*session*/) {
  const StudyDesign design = load_study_design(arguments.design);
  if (!arguments.file.empty()) {
    check_not_an_input(arguments.file, {{arguments.design}});
    write_whole_file(arguments.file, design.toml);
  }
  std::vector<std::string> conditions, effect_texts;
  for (const StudyCondition& condition : conditions_of_group(design, 0)) conditions.push_back(condition.name);
  Json effects = Json::array();
  for (const DesignEffect& effect : degrees_of_freedom(design)) {
    effects.push_back({{"effect", effect.name},
                       {"df", effect.effect},
                       {"df_error_subjects", effect.error_subjects},
                       {"df_error_items", effect.error_items}});
    effect_texts.push_back(
        fmt::format("{}: F1({}, {}){}", effect.name, effect.effect, effect.error_subjects,
                    effect.error_items > 0 ? fmt::format(", F2({}, {})", effect.effect, effect.error_items) : ""));
  }
  const DesignBalance balance = count_balance(design);
  const auto groups = group_count(design);
  const std::size_t trials = conditions.size() * static_cast<std::size_t>(design.repetitions);
  return {{{"name", design.name, fmt::format("{}: {}", design.name, design.title)},
           {"subjects", design.subjects,
            fmt::format("subjects: {}{}", design.subjects, groups > 1 ? fmt::format(" in {} groups", groups) : "")},
           {"groups", groups},
           {"conditions", conditions, fmt::format("conditions: {}\n{}", conditions.size(), lines("  ", conditions))},
           {"trials", trials, fmt::format("trials of a subject: {}, after {} for practice", trials, design.practice)},
           {"items", design.item_count, fmt::format("items: {}", design.item_count)},
           {"order", order_text(design), fmt::format("order: {}", order_text(design))},
           {"balanced",
            {{"positions", balance.positions}, {"follows", balance.follows}, {"items", balance.items}},
            text_of(balance)},
           {"effects", effects, lines({}, effect_texts)}}};
}

Rows design_rows(StudyDesignArguments& a) {
  std::string names;
  for (const BuiltInDesign& built_in : built_in_designs()) names += fmt::format("{}, ", built_in.name);
  return {row("design", required(of_type("NAME|FILE.toml", text(a.design))), fmt::format("{}or a TOML file", names)),
          row("-o,--output", of_type("FILE.toml", output_name(a.file)), "Copy of the design, to be changed")};
}

}  // namespace

Command study_design_command() {
  return make_command("design", "Check the design of an experiment, and show its order and balance", design_rows,
                      run_study_design,
                      R"(Examples:
  wheatstone study design path-searching-1
  wheatstone study design path-searching-2 -o mine.toml && wheatstone study design mine.toml)");
}

}  // namespace wheatstone::cli
