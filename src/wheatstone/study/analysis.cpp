#include "wheatstone/study/analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone {
namespace {

/// A sum that becomes a mean.
struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? not_available : sum / count; }
};

double deviation_of(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return not_available;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The study as numbers: which conditions there are, and in which cells of the factors they lie.
class Layout {
 public:
  explicit Layout(const StudyDesign& design)
      : design_(design), groups_(group_count(design)), conditions_(conditions_of_group(design, 0)) {
    for (int group = 0; group < groups_; ++group) {
      std::vector<int> levels;
      int rest = group;
      for (auto factor = design.factors.rbegin(); factor != design.factors.rend(); ++factor) {
        if (!factor->between) continue;
        levels.insert(levels.begin(), rest % static_cast<int>(factor->levels.size()));
        rest /= static_cast<int>(factor->levels.size());
      }
      levels_of_group_.push_back(levels);
    }
  }

  const StudyDesign& design() const { return design_; }
  int groups() const { return groups_; }
  const std::vector<StudyCondition>& conditions() const { return conditions_; }
  int condition_count() const { return static_cast<int>(conditions_.size()); }
  /// Those that are combinations of the factors; controls stand behind them.
  int crossed() const { return static_cast<int>(std::ranges::count(conditions_, false, &StudyCondition::is_control)); }
  const std::vector<int>& levels_of_group(int group) const { return levels_of_group_[static_cast<std::size_t>(group)]; }

  /// The level of a factor within that a condition has.
  int level_of(int condition, std::size_t factor) const {
    int below = 1;
    for (std::size_t i = factor + 1; i < design_.factors.size(); ++i)
      if (!design_.factors[i].between) below *= static_cast<int>(design_.factors[i].levels.size());
    return condition / below % static_cast<int>(design_.factors[factor].levels.size());
  }

 private:
  const StudyDesign& design_;
  int groups_;
  std::vector<StudyCondition> conditions_;
  std::vector<std::vector<int>> levels_of_group_;
};

/// A value of each trial that counts.
struct CountedTrial {
  int subject = 0, group = 0, condition = 0, item = 0;
  double value = 0;
};
using CountedTrials = std::vector<CountedTrial>;

template <class Value>
CountedTrials counted(const StudyData& data, Value value_of) {
  CountedTrials trials;
  for (int subject = 0; subject < std::ssize(data.subjects); ++subject) {
    const SubjectRecords& records = data.subjects[static_cast<std::size_t>(subject)];
    const int group = group_of_subject(data.design, records.number);
    for (const TrialRecord& record : records.trials)
      if (const std::optional<double> value = value_of(record))
        trials.push_back({subject, group, record.condition, record.item, *value});
  }
  return trials;
}

/// Means of cells: [unit][cell].
using Cells = std::vector<std::vector<double>>;

template <class Unit, class Cell>
Cells means_of(const CountedTrials& trials, int units, int cells, Unit unit_of, Cell cell_of) {
  std::vector<Mean> sums(static_cast<std::size_t>(units) * static_cast<std::size_t>(cells));
  for (const CountedTrial& trial : trials) {
    const int cell = cell_of(trial);
    if (cell >= 0)
      sums[static_cast<std::size_t>(unit_of(trial)) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(cell)]
          .add(trial.value);
  }
  Cells means(static_cast<std::size_t>(units), std::vector<double>(static_cast<std::size_t>(cells)));
  for (std::size_t i = 0; i < sums.size(); ++i)
    means[i / static_cast<std::size_t>(cells)][i % static_cast<std::size_t>(cells)] = sums[i].value();
  return means;
}

int subject_of(const CountedTrial& trial) { return trial.subject; }
int item_of(const CountedTrial& trial) { return trial.item; }

AnovaResult anova_by_subjects(const StudyData& data, const Layout& layout, const CountedTrials& trials) {
  AnovaData anova;
  for (const StudyFactor& factor : data.design.factors)
    anova.factors.push_back({factor.name, static_cast<int>(factor.levels.size()), factor.between});
  for (const SubjectRecords& subject : data.subjects) {
    anova.units.push_back("sub-" + subject_label(data.design, subject.number));
    anova.groups.push_back(layout.levels_of_group(group_of_subject(data.design, subject.number)));
  }
  const int crossed = layout.crossed();
  anova.values =
      means_of(trials, static_cast<int>(data.subjects.size()), crossed, subject_of,
               [crossed](const CountedTrial& trial) { return trial.condition < crossed ? trial.condition : -1; });
  return repeated_measures_anova(anova);
}

/// The cell of all factors, which are all within items, in the order of the design's factors.
int item_cell(const Layout& layout, const CountedTrial& trial) {
  const StudyDesign& design = layout.design();
  int cell = 0;
  std::size_t between = 0;
  for (std::size_t i = 0; i < design.factors.size(); ++i) {
    const int level = design.factors[i].between ? layout.levels_of_group(trial.group)[between++]
                                                : layout.level_of(trial.condition, i);
    cell = cell * static_cast<int>(design.factors[i].levels.size()) + level;
  }
  return cell;
}

AnovaResult anova_by_items(const StudyData& data, const Layout& layout, const CountedTrials& trials) {
  const int crossed = layout.crossed(), items = data.design.item_count;
  AnovaData anova;
  for (const StudyFactor& factor : data.design.factors)
    anova.factors.push_back({factor.name, static_cast<int>(factor.levels.size())});
  for (int item = 0; item < items; ++item) anova.units.push_back(item_name(data.design, item));
  anova.values = means_of(trials, items, crossed * layout.groups(), item_of, [&](const CountedTrial& trial) {
    return trial.condition < crossed ? item_cell(layout, trial) : -1;
  });
  return repeated_measures_anova(anova);
}

std::vector<ConditionMean> condition_means(const StudyData& data, const Layout& layout, const CountedTrials& trials) {
  const int count = layout.condition_count();
  const Cells cells = means_of(trials, static_cast<int>(data.subjects.size()), count * layout.groups(), subject_of,
                               [count](const CountedTrial& trial) { return trial.group * count + trial.condition; });
  std::vector<ConditionMean> means;
  for (int cell = 0; cell < count * layout.groups(); ++cell) {
    std::vector<double> values;
    for (const std::vector<double>& subject : cells)
      if (!std::isnan(subject[static_cast<std::size_t>(cell)]))
        values.push_back(subject[static_cast<std::size_t>(cell)]);
    ConditionMean mean{.condition = layout.conditions()[static_cast<std::size_t>(cell % count)].name,
                       .subjects = static_cast<int>(values.size())};
    std::size_t between = 0;
    for (const StudyFactor& factor : data.design.factors)
      if (factor.between) {
        const int level = layout.levels_of_group(cell / count)[between++];
        mean.condition =
            fmt::format("{}={},{}", factor.name, factor.levels[static_cast<std::size_t>(level)].name, mean.condition);
      }
    if (!values.empty()) mean.mean = mean_of(values);
    mean.deviation = deviation_of(values, mean.mean);
    mean.standard_error = mean.deviation / std::sqrt(static_cast<double>(values.size()));
    means.push_back(mean);
  }
  return means;
}

/// The values of one cell of each unit.
std::vector<double> column(const Cells& cells, std::size_t cell) {
  std::vector<double> values;
  for (const std::vector<double>& unit : cells) values.push_back(unit[cell]);
  return values;
}

/// All pairs of a factor's levels and the controls.
void compare_levels(const StudyData& data, const Layout& layout, const CountedTrials& trials, std::size_t factor,
                    std::vector<PlannedComparison>& all) {
  const StudyFactor& compared = data.design.factors[factor];
  const int levels = static_cast<int>(compared.levels.size()), crossed = layout.crossed();
  const int cells = levels + layout.condition_count() - crossed;
  const auto cell_of = [&](const CountedTrial& trial) {
    return trial.condition < crossed ? layout.level_of(trial.condition, factor) : levels + trial.condition - crossed;
  };
  const Cells subjects = means_of(trials, static_cast<int>(data.subjects.size()), cells, subject_of, cell_of);
  const Cells items = means_of(trials, data.design.item_count, cells, item_of, cell_of);
  const auto name_of = [&](int cell) {
    return cell < levels ? fmt::format("{}={}", compared.name, compared.levels[static_cast<std::size_t>(cell)].name)
                         : data.design.controls[static_cast<std::size_t>(cell - levels)].name;
  };
  std::vector<PlannedComparison> comparisons;
  std::vector<double> p_subjects, p_items;
  for (int a = 0; a < levels; ++a)
    for (int b = a + 1; b < cells; ++b) {
      const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
      comparisons.push_back({.name = fmt::format("{} - {}", name_of(a), name_of(b)),
                             .by_subjects = paired_t(column(subjects, first), column(subjects, second)),
                             .by_items = paired_t(column(items, first), column(items, second))});
      p_subjects.push_back(comparisons.back().by_subjects.p);
      p_items.push_back(comparisons.back().by_items.p);
    }
  p_subjects = holm_corrected(p_subjects);
  p_items = holm_corrected(p_items);
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    comparisons[i].holm_subjects = p_subjects[i];
    comparisons[i].holm_items = p_items[i];
    all.push_back(comparisons[i]);
  }
}

MeasureAnalysis analyse_measure(const StudyData& data, const Layout& layout, const CountedTrials& trials,
                                MeasureAnalysis measure) {
  measure.means = condition_means(data, layout, trials);
  if (layout.crossed() > 0) {
    measure.by_subjects = anova_by_subjects(data, layout, trials);
    measure.by_items = anova_by_items(data, layout, trials);
    if (measure.by_subjects.effects.size() == measure.by_items.effects.size())
      for (std::size_t i = 0; i < measure.by_subjects.effects.size(); ++i)
        measure.min_f.push_back(min_f_prime(measure.by_subjects.effects[i], measure.by_items.effects[i]));
  }
  for (std::size_t factor = 0; factor < data.design.factors.size(); ++factor)
    if (!data.design.factors[factor].between) compare_levels(data, layout, trials, factor, measure.comparisons);
  return measure;
}

/// What a subject's response times may be.
struct TimeLimits {
  double least = -INFINITY, most = INFINITY;
};

TimeLimits time_limits(const StudyDesign& design, const SubjectRecords& subject, double deviations) {
  std::vector<double> times;
  for (const TrialRecord& record : subject.trials)
    if (is_correct(design, record).value_or(true)) times.push_back(record.response_time_s);
  if (deviations <= 0 || times.size() < 3) return {};
  const double mean = mean_of(times), deviation = deviation_of(times, mean);
  return {mean - deviations * deviation, mean + deviations * deviation};
}

/// The response times that count, and how many of the others there are.
CountedTrials response_times(const StudyData& data, double deviations, StudyAnalysis& analysis) {
  CountedTrials trials;
  for (int subject = 0; subject < std::ssize(data.subjects); ++subject) {
    const SubjectRecords& records = data.subjects[static_cast<std::size_t>(subject)];
    const TimeLimits limits = time_limits(data.design, records, deviations);
    const int group = group_of_subject(data.design, records.number);
    for (const TrialRecord& record : records.trials) {
      if (!is_correct(data.design, record).value_or(true))
        ++analysis.wrong_answers;
      else if (record.response_time_s < limits.least || record.response_time_s > limits.most)
        ++analysis.outliers;
      else
        trials.push_back({subject, group, record.condition, record.item, record.response_time_s});
    }
  }
  return trials;
}

/// The value below which this share of sorted values lies, interpolated (R's type 7).
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

HeadMovement head_movement(const std::string& condition, std::vector<double> ranges) {
  std::ranges::sort(ranges);
  HeadMovement box{.condition = condition,
                   .lower_quartile = quantile(ranges, 0.25),
                   .median = quantile(ranges, 0.5),
                   .upper_quartile = quantile(ranges, 0.75),
                   .trials = static_cast<int>(ranges.size())};
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  box.least = box.upper_quartile;
  box.most = box.lower_quartile;
  for (const double range : ranges) {
    if (range < box.lower_quartile - reach || range > box.upper_quartile + reach) {
      box.outside.push_back(range);
    } else {
      box.least = std::min(box.least, range);
      box.most = std::max(box.most, range);
    }
  }
  return box;
}

std::vector<HeadMovement> head_movements(const StudyData& data, const Layout& layout) {
  std::vector<HeadMovement> movements;
  for (int condition = 0; condition < layout.condition_count(); ++condition) {
    std::vector<double> ranges;
    for (const SubjectRecords& subject : data.subjects)
      for (const TrialRecord& record : subject.trials)
        if (record.condition == condition && !std::isnan(record.head_most_m))
          ranges.push_back(record.head_most_m - record.head_least_m);
    if (!ranges.empty())
      movements.push_back(head_movement(layout.conditions()[static_cast<std::size_t>(condition)].name, ranges));
  }
  return movements;
}

std::vector<QuestionMean> question_means(const StudyData& data) {
  std::vector<QuestionMean> means;
  for (const StudyQuestion& question : data.design.questions) {
    std::vector<double> values;
    for (const SubjectRecords& subject : data.subjects)
      for (const auto& [name, answer] : subject.answers)
        if (name == question.name) values.push_back(answer);
    if (values.empty()) continue;
    const double mean = mean_of(values);
    means.push_back({question.name, mean, deviation_of(values, mean), static_cast<int>(values.size())});
  }
  return means;
}

std::string rule_text(const StudyDesign& design, double deviations) {
  const std::string_view which =
      design.task == StudyTask::path ? "Response times of correct answers only" : "Response times";
  if (deviations <= 0) return fmt::format("{}; none is left out as an outlier.", which);
  return fmt::format("{}; one that lies more than {} standard deviations from its subject's mean is left out.", which,
                     deviations);
}

}  // namespace

StudyAnalysis analyse_study(const StudyData& all, const AnalysisOptions& options) {
  StudyData data{.design = all.design, .simulated = all.simulated};
  std::vector<std::string> without_trials;
  for (const SubjectRecords& subject : all.subjects)
    if (subject.trials.empty())
      without_trials.push_back("sub-" + subject_label(data.design, subject.number));
    else
      data.subjects.push_back(subject);
  const Layout layout(data.design);
  StudyAnalysis analysis{.subjects = static_cast<int>(data.subjects.size()),
                         .without_trials = std::move(without_trials),
                         .outlier_rule = rule_text(data.design, options.outlier_deviations)};
  const int all_trials = layout.condition_count() * data.design.repetitions;
  for (const SubjectRecords& subject : data.subjects) {
    analysis.trials += static_cast<int>(subject.trials.size());
    if (std::ssize(subject.trials) < all_trials || subject.answers.size() < data.design.questions.size())
      analysis.unfinished.push_back("sub-" + subject_label(data.design, subject.number));
  }
  if (analysis.trials == 0) throw Error(ErrorKind::bad_input, "the study has no trials yet, expected at least one");
  const CountedTrials times = response_times(data, options.outlier_deviations, analysis);
  const MeasureAnalysis time{.name = "response_time", .text = "Response time", .unit = "s"};
  if (data.design.task == StudyTask::path) {
    analysis.measures.push_back(analyse_measure(data, layout, times, time));
    const auto percent = [&data](const TrialRecord& record) -> std::optional<double> {
      return *is_correct(data.design, record) ? 100.0 : 0.0;
    };
    analysis.measures.push_back(analyse_measure(data, layout, counted(data, percent),
                                                {.name = "percent_correct", .text = "Correct answers", .unit = "%"}));
  } else {
    const auto rating = [](const TrialRecord& record) -> std::optional<double> { return record.response; };
    analysis.measures.push_back(
        analyse_measure(data, layout, counted(data, rating), {.name = "rating", .text = "Rating"}));
    analysis.measures.push_back(analyse_measure(data, layout, times, time));
  }
  analysis.head_movement = head_movements(data, layout);
  analysis.questions = question_means(data);
  return analysis;
}

}  // namespace wheatstone
