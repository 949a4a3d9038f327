#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <string>

#include "commands.h"
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
  bool against_published = false;
};

constexpr std::array<Choice<bool>, 1> references{{{"published", true}}};

std::string text_of(const AnovaEffect& effect, std::string_view test) {
  if (std::isnan(effect.f))
    return fmt::format("  {} {}({}, {}) n/a: there is no variance", effect.name, test, effect.df_effect,
                       effect.df_error);
  return fmt::format("  {} {}({}, {}) = {:.2f}, p {}, partial eta squared {:.3f}", effect.name, test, effect.df_effect,
                     effect.df_error, effect.f, effect.p < 0.0001 ? "< 0.0001" : fmt::format("= {:.4f}", effect.p),
                     effect.partial_eta_squared);
}

std::string text_of(const MeasureAnalysis& measure) {
  std::vector<std::string> all{measure.name};
  for (const AnovaEffect& effect : measure.by_subjects.effects) all.push_back(text_of(effect, "F1"));
  for (const AnovaEffect& effect : measure.by_items.effects) all.push_back(text_of(effect, "F2"));
  for (const std::string& name : measure.by_subjects.left_out)
    all.push_back(fmt::format("  left out: {} has a missing cell", name));
  return lines({}, all);
}

std::string text_of(const PublishedComparison& comparison) {
  std::vector<std::string> all{
      fmt::format("{} beside what was published: rank correlation {:.2f}", comparison.measure, comparison.order)};
  for (const BesidePublished& one : comparison.conditions)
    all.push_back(fmt::format("  {}: {:.2f}, published {:.2f} (SD {:.2f}): {:+.2f} SD", one.condition, one.mean,
                              one.published, one.published_deviation, one.off));
  return lines({}, all);
}

Json json_of(const PublishedComparison& comparison) {
  Json conditions;
  for (const BesidePublished& one : comparison.conditions)
    conditions[one.condition] = {
        {"mean", one.mean}, {"published_mean", one.published}, {"published_deviation", one.published_deviation}};
  return {{"rank_correlation", comparison.order}, {"conditions", conditions}};
}

Json json_of(const AnovaResult& result) {
  Json effects = Json::array();
  for (const AnovaEffect& effect : result.effects)
    effects.push_back({{"effect", effect.name},
                       {"F", effect.f},
                       {"df", {effect.df_effect, effect.df_error}},
                       {"p", effect.p},
                       {"partial_eta_squared", effect.partial_eta_squared}});
  return effects;
}

Report run_study_analyse(const StudyAnalyseArguments& arguments, const Session& session) {
  const StudyData data = read_study(arguments.study);
  const StudyAnalysis analysis = analyse_study(data, arguments.options);
  const std::vector<PublishedComparison> published =
      arguments.against_published ? beside_published(data.design, analysis) : std::vector<PublishedComparison>();
  OutputFolder folder(arguments.folder, {arguments.study});
  for (const auto& [name, table] : analysis_tables(data, analysis, published))
    write_whole_file(folder.file(name), table);
  write_whole_file(folder.file("analysis.html"), analysis_page(data, analysis, published));
  folder.commit();
  if (!analysis.without_trials.empty())
    remark(session, fmt::format("wheatstone: warning: {}: no trials of {}, which do not count", arguments.study,
                                fmt::join(analysis.without_trials, ", ")));
  Json measures;
  std::vector<std::string> texts;
  for (const MeasureAnalysis& measure : analysis.measures) {
    measures[measure.name] = {{"by_subjects", json_of(measure.by_subjects)},
                              {"by_items", json_of(measure.by_items)},
                              {"left_out", measure.by_subjects.left_out}};
    texts.push_back(text_of(measure));
  }
  Json beside;
  for (const PublishedComparison& comparison : published) {
    beside[comparison.measure] = json_of(comparison);
    texts.push_back(text_of(comparison));
  }
  const std::vector<std::string>& unfinished = analysis.unfinished;
  return {{{"simulated", data.simulated, data.simulated ? "simulated observers: no person took part" : ""},
           {"subjects", analysis.subjects, fmt::format("subjects: {}, trials: {}", analysis.subjects, analysis.trials)},
           {"trials", analysis.trials},
           {"unfinished", unfinished,
            unfinished.empty() ? "" : fmt::format("not finished: {}", fmt::join(unfinished, ", "))},
           {"without_trials", analysis.without_trials},
           {"outliers", analysis.outliers},
           {"published", beside},
           {"measures", measures, lines({}, texts)}}};
}

Rows analyse_rows(StudyAnalyseArguments& a) {
  return {row("study", required(of_type("DIR", text(a.study))), "Folder of the data"),
          row("-o,--output", output_name(a.folder), "Output folder"),
          row("--outliers", number(a.options.outlier_deviations, {0, 100}),
              "Response times farther from the subject's mean than so many standard deviations are left out; 0: none"),
          row("--against", choice(a.against_published, references),
              "Put the means beside those of the publication that the design follows")};
}

}  // namespace

Command study_analyse_command() {
  return make_command("analyse", "Analyse the data of an experiment: a page with figures, and tables", analyse_rows,
                      run_study_analyse,
                      R"(Example:
  wheatstone study simulate path-searching-1 -o data && wheatstone study analyse data -o analysis)");
}

}  // namespace wheatstone::cli
