#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "output_option.h"
#include "print_facts.h"
#include "study_kinds.h"
#include "typed_options.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/analysis_report.h"
#include "wheatstone/study/study_folder.h"

namespace wheatstone::cli {
namespace {

struct StudyAnalyseArguments {
  std::string study;
  std::string folder = "analysis";
  AnalysisOptions options;
};

void print_text(const StudyData& data, const StudyAnalysis& analysis, const Session& session) {
  if (data.simulated) fmt::print(session.output, "simulated observers: no person took part\n");
  fmt::print(session.output, "subjects: {}, trials: {}\n", analysis.subjects, analysis.trials);
  if (!analysis.unfinished.empty())
    fmt::print(session.output, "not finished: {}\n", fmt::join(analysis.unfinished, ", "));
  for (const MeasureAnalysis& measure : analysis.measures) {
    fmt::print(session.output, "{}\n", measure.name);
    const auto print = [&](std::string_view test, const AnovaEffect& effect) {
      if (std::isnan(effect.f))
        fmt::print(session.output, "  {} {}({}, {}) n/a: there is no variance\n", effect.name, test, effect.df_effect,
                   effect.df_error);
      else
        fmt::print(session.output, "  {} {}({}, {}) = {:.2f}, p {}, partial eta squared {:.3f}\n", effect.name, test,
                   effect.df_effect, effect.df_error, effect.f,
                   effect.p < 0.0001 ? "< 0.0001" : fmt::format("= {:.4f}", effect.p), effect.partial_eta_squared);
    };
    for (const AnovaEffect& effect : measure.by_subjects.effects) print("F1", effect);
    for (const AnovaEffect& effect : measure.by_items.effects) print("F2", effect);
    for (const std::string& name : measure.by_subjects.left_out)
      fmt::print(session.output, "  left out: {} has a missing cell\n", name);
  }
}

void print_json(const StudyData& data, const StudyAnalysis& analysis, const Session& session) {
  nlohmann::ordered_json measures;
  for (const MeasureAnalysis& measure : analysis.measures) {
    nlohmann::ordered_json& told = measures[measure.name];
    const auto list = [](const AnovaResult& result) {
      nlohmann::ordered_json effects = nlohmann::ordered_json::array();
      for (const AnovaEffect& effect : result.effects)
        effects.push_back({{"effect", effect.name},
                           {"F", effect.f},
                           {"df", {effect.df_effect, effect.df_error}},
                           {"p", effect.p},
                           {"partial_eta_squared", effect.partial_eta_squared}});
      return effects;
    };
    told["by_subjects"] = list(measure.by_subjects);
    told["by_items"] = list(measure.by_items);
    told["left_out"] = measure.by_subjects.left_out;
  }
  print_facts({{"simulated", data.simulated},
               {"subjects", analysis.subjects},
               {"trials", analysis.trials},
               {"unfinished", analysis.unfinished},
               {"without_trials", analysis.without_trials},
               {"outliers", analysis.outliers},
               {"measures", measures}},
              session);
}

void run_study_analyse(const StudyAnalyseArguments& arguments, const Session& session) {
  const StudyData data = read_study(arguments.study);
  const StudyAnalysis analysis = analyse_study(data, arguments.options);
  OutputFolder folder(arguments.folder, {arguments.study});
  for (const auto& [name, table] : analysis_tables(data, analysis)) write_whole_file(folder.file(name), table);
  write_whole_file(folder.file("analysis.html"), analysis_page(data, analysis));
  folder.commit();
  if (!analysis.without_trials.empty() && !session.quiet)
    fmt::print(session.errors, "wheatstone: warning: {}: no trials of {}, which do not count\n", arguments.study,
               fmt::join(analysis.without_trials, ", "));
  if (session.json)
    print_json(data, analysis, session);
  else
    print_text(data, analysis, session);
}

}  // namespace

void add_study_analyse(CLI::App& study, const Session& session) {
  const auto arguments = std::make_shared<StudyAnalyseArguments>();
  CLI::App& command =
      *study.add_subcommand("analyse", "Analyse the data of an experiment: a page with figures, and tables");
  command.fallthrough();
  command.add_option("study", arguments->study, "Folder of the data")->required()->type_name("DIR");
  add_output_option(command, arguments->folder, "Output folder");
  add_number(command, "--outliers", arguments->options.outlier_deviations, {0, 100},
             "Response times farther from the subject's mean than so many standard deviations are left out; 0: none");
  command.footer(
      "Example:\n  wheatstone study simulate path-searching-1 -o data && wheatstone study analyse data -o analysis");
  command.callback([arguments, &session] { run_study_analyse(*arguments, session); });
}

}  // namespace wheatstone::cli
