#include "wheatstone/study/analysis_report.h"

#include <fmt/ranges.h>

#include <cmath>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/study/figures_internal.h"

namespace wheatstone {
namespace {

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

std::string number(double value, int digits = 4) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "n/a";
}

/// p with four digits, or in powers of ten where it is smaller.
std::string p_text(double p) {
  if (!std::isfinite(p)) return "n/a";
  return p < 0.0001 && p > 0 ? fmt::format("{:.2e}", p) : number(p);
}

/// Degrees of freedom: whole except those of min F′.
std::string df_text(double df) { return df == std::floor(df) ? number(df, 0) : number(df, 2); }

Row effect_row(const MeasureAnalysis& measure, std::string_view kind, const AnovaResult& result,
               const AnovaEffect& effect) {
  Row row{measure.name,
          std::string(kind),
          effect.name,
          number(effect.f),
          df_text(effect.df_effect),
          df_text(effect.df_error),
          p_text(effect.p),
          number(effect.partial_eta_squared),
          number(effect.generalised_eta_squared)};
  if (const auto& s = effect.sphericity)
    row.insert(row.end(), {number(s->mauchly_w), p_text(s->mauchly_p), number(s->greenhouse_geisser),
                           p_text(s->greenhouse_geisser_p), number(s->huynh_feldt), p_text(s->huynh_feldt_p)});
  else
    row.insert(row.end(), 6, "n/a");
  row.push_back(fmt::format("{}", result.units));
  return row;
}

Rows effect_rows(const MeasureAnalysis& measure) {
  Rows rows;
  for (std::size_t i = 0; i < measure.by_subjects.effects.size(); ++i) {
    rows.push_back(effect_row(measure, "F1", measure.by_subjects, measure.by_subjects.effects[i]));
    if (i < measure.by_items.effects.size())
      rows.push_back(effect_row(measure, "F2", measure.by_items, measure.by_items.effects[i]));
    if (i >= measure.min_f.size()) continue;
    const MinF& min_f = measure.min_f[i];
    Row row{measure.name,
            "minF'",
            measure.by_subjects.effects[i].name,
            number(min_f.f),
            df_text(min_f.df_effect),
            df_text(min_f.df_error),
            p_text(min_f.p)};
    row.insert(row.end(), 9, "n/a");
    rows.push_back(row);
  }
  return rows;
}

const Row effect_columns{"measure",
                         "test",
                         "effect",
                         "F",
                         "df_effect",
                         "df_error",
                         "p",
                         "partial_eta_squared",
                         "generalised_eta_squared",
                         "mauchly_W",
                         "mauchly_p",
                         "greenhouse_geisser_epsilon",
                         "greenhouse_geisser_p",
                         "huynh_feldt_epsilon",
                         "huynh_feldt_p",
                         "units"};

Rows mean_rows(const MeasureAnalysis& measure) {
  Rows rows;
  for (const ConditionMean& mean : measure.means)
    rows.push_back({measure.name, mean.condition, number(mean.mean), number(mean.deviation),
                    number(mean.standard_error), fmt::format("{}", mean.subjects)});
  return rows;
}

const Row mean_columns{"measure", "condition", "mean", "standard_deviation", "standard_error", "subjects"};

Rows comparison_rows(const MeasureAnalysis& measure) {
  Rows rows;
  const auto add = [&](const PlannedComparison& comparison, std::string_view test, const PairedT& t, double holm) {
    if (t.df > 0)
      rows.push_back({measure.name, comparison.name, std::string(test), number(t.mean), number(t.standard_error),
                      number(t.t), df_text(t.df), p_text(t.p), p_text(holm), number(t.cohens_dz)});
  };
  for (const PlannedComparison& comparison : measure.comparisons) {
    add(comparison, "t1", comparison.by_subjects, comparison.holm_subjects);
    add(comparison, "t2", comparison.by_items, comparison.holm_items);
  }
  return rows;
}

const Row comparison_columns{"measure", "comparison", "test", "difference", "standard_error",
                             "t",       "df",         "p",    "p_holm",     "cohens_dz"};

Rows movement_rows(const std::vector<HeadMovement>& movement) {
  Rows rows;
  for (const HeadMovement& box : movement)
    rows.push_back({box.condition, number(box.least), number(box.lower_quartile), number(box.median),
                    number(box.upper_quartile), number(box.most), fmt::format("{}", box.outside.size()),
                    fmt::format("{}", box.trials)});
  return rows;
}

const Row movement_columns{"condition",      "least", "lower_quartile", "median",
                           "upper_quartile", "most",  "outside",        "trials"};

Rows question_rows(const std::vector<QuestionMean>& questions) {
  Rows rows;
  for (const QuestionMean& question : questions)
    rows.push_back(
        {question.name, number(question.mean, 2), number(question.deviation, 2), fmt::format("{}", question.subjects)});
  return rows;
}

const Row question_columns{"question", "mean", "standard_deviation", "subjects"};

Rows published_rows(const PublishedComparison& comparison) {
  Rows rows;
  for (const BesidePublished& one : comparison.conditions)
    rows.push_back({comparison.measure, one.condition, number(one.mean), number(one.published),
                    number(one.published_deviation), number(one.off, 2)});
  return rows;
}

const Row published_columns{"measure",        "condition",           "mean",
                            "published_mean", "published_deviation", "deviations_above"};

std::string tsv(Row columns, const Rows& rows, bool simulated) {
  columns.emplace_back("observer");
  std::string text;
  const auto add = [&text](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : "\t") + row[i];
    text += '\n';
  };
  add(columns);
  for (Row row : rows) {
    row.emplace_back(simulated ? "simulated" : "person");
    add(row);
  }
  return text;
}

std::string html_table(const Row& columns, const Rows& rows) {
  std::string html = "<table><tr>";
  for (const std::string& column : columns) html += fmt::format("<th>{}</th>", html_text(column));
  html += "</tr>\n";
  for (const Row& row : rows) {
    html += "<tr>";
    for (const std::string& field : row) html += fmt::format("<td>{}</td>", html_text(field));
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

/// Subjects or items that an analysis leaves out; empty where there are none.
std::string left_out_text(std::string_view what, const AnovaResult& result) {
  if (result.left_out.empty()) return {};
  std::string names;
  for (const std::string& name : result.left_out) names += (names.empty() ? "" : ", ") + name;
  return fmt::format("<p>Without {} with a missing cell: {}.</p>\n", what, html_text(names));
}

std::string measure_section(const MeasureAnalysis& measure) {
  return fmt::format("<h2>{}</h2>\n", html_text(measure.text)) + means_figure(measure) +
         "<p>Means of subjects; bars are one standard error.</p>\n" + html_table(mean_columns, mean_rows(measure)) +
         "<h3>Analysis of variance</h3>\n" + left_out_text("subjects", measure.by_subjects) +
         left_out_text("items", measure.by_items) + html_table(effect_columns, effect_rows(measure)) +
         "<h3>Comparisons of levels</h3>\n" + html_table(comparison_columns, comparison_rows(measure));
}

constexpr std::string_view style =
    "body{font-family:sans-serif;max-width:75em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;font-size:.8em;margin:1em 0}th,td{border-bottom:1px solid #ccc;padding:.25em .6em;"
    "text-align:left}.simulated{background:#b00020;color:#fff;padding:.6em 1em;font-weight:bold}";

}  // namespace

std::vector<std::pair<std::string, std::string>> analysis_tables(const StudyData& data, const StudyAnalysis& analysis,
                                                                 const std::vector<PublishedComparison>& published) {
  Rows means, effects, comparisons;
  const auto append = [](Rows& all, const Rows& rows) { all.insert(all.end(), rows.begin(), rows.end()); };
  for (const MeasureAnalysis& measure : analysis.measures) {
    append(means, mean_rows(measure));
    append(effects, effect_rows(measure));
    append(comparisons, comparison_rows(measure));
  }
  std::vector<std::pair<std::string, std::string>> tables{
      {"means.tsv", tsv(mean_columns, means, data.simulated)},
      {"effects.tsv", tsv(effect_columns, effects, data.simulated)},
      {"comparisons.tsv", tsv(comparison_columns, comparisons, data.simulated)},
      {"head_movement.tsv", tsv(movement_columns, movement_rows(analysis.head_movement), data.simulated)},
      {"questions.tsv", tsv(question_columns, question_rows(analysis.questions), data.simulated)}};
  Rows beside;
  for (const PublishedComparison& comparison : published) append(beside, published_rows(comparison));
  if (!beside.empty()) tables.emplace_back("published.tsv", tsv(published_columns, beside, data.simulated));
  return tables;
}

std::string analysis_page(const StudyData& data, const StudyAnalysis& analysis,
                          const std::vector<PublishedComparison>& published) {
  std::string page = html_head(data.design.title, style) + fmt::format("<h1>{}</h1>\n", html_text(data.design.title));
  if (data.simulated) page += "<p class=\"simulated\">Simulated observers: no person took part.</p>\n";
  page += fmt::format(
      "<p>{} subjects, {} trials. {} wrong answers and {} outliers do not count as response times. {}</p>\n",
      analysis.subjects, analysis.trials, analysis.wrong_answers, analysis.outliers, html_text(analysis.outlier_rule));
  for (const auto& [what, subjects] :
       {std::pair{"Not finished", &analysis.unfinished}, std::pair{"Without trials", &analysis.without_trials}})
    if (!subjects->empty())
      page += fmt::format("<p>{}: {}.</p>\n", what, html_text(fmt::format("{}", fmt::join(*subjects, ", "))));
  for (const MeasureAnalysis& measure : analysis.measures) page += measure_section(measure);
  for (const PublishedComparison& comparison : published)
    page += fmt::format("<h2>Beside what was published: {}</h2>\n<p>Rank correlation of the means: {}.</p>\n",
                        html_text(comparison.measure), number(comparison.order, 2)) +
            html_table(published_columns, published_rows(comparison));
  if (!analysis.head_movement.empty())
    page += "<h2>Head movement</h2>\n" + head_movement_figure(analysis.head_movement) +
            "<p>From the leftmost to the rightmost place of a trial; the table is in m.</p>\n" +
            html_table(movement_columns, movement_rows(analysis.head_movement));
  if (!analysis.questions.empty())
    page += "<h2>Questions</h2>\n" + html_table(question_columns, question_rows(analysis.questions));
  return page + "</body></html>\n";
}

}  // namespace wheatstone
