#include "wheatstone/study/simulate.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/study/draw_lots_internal.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone {
namespace {

constexpr std::uint64_t item_key = 0x6974656d73;
constexpr double shortest_s = 0.3;  // nobody answers before

/// Log-normally distributed with this mean and deviation.
double log_normal(double mean, double deviation, Lots& lots) {
  const double spread = std::log(1 + deviation * deviation / (mean * mean));
  return mean * std::exp(std::sqrt(spread) * lots.normal() - spread / 2);
}

/// What a condition's levels add.
SimulatedEffect sum_of_effects(const StudyDesign& design, const SimulatedObservers& observers,
                               const StudyCondition& condition) {
  SimulatedEffect sum;
  for (const SimulatedEffect& effect : observers.effects) {
    bool holds = condition.name == effect.condition;
    for (std::size_t i = 0; i < design.factors.size(); ++i)
      holds = holds || (design.factors[i].name == effect.factor && condition.levels[i] == effect.level);
    if (!holds) continue;
    sum.seconds += effect.seconds;
    sum.share += effect.share;
    if (effect.rating_noise > 0) sum.rating_noise = effect.rating_noise;
  }
  return sum;
}

/// An item is as hard for all observers of a study.
double item_seconds(const SimulatedObservers& observers, int item, std::uint64_t seed) {
  Lots lots({seed, item_key, static_cast<std::uint64_t>(item)});
  return observers.between_items_s * lots.normal();
}

int answer_path(const StudyDesign& design, int item, double correct, Lots& lots) {
  const bool right = lots.unit() < correct;
  return is_connected(design, item) == right ? 1 : 0;
}

int answer_rating(const StudyDesign& design, double mean, double noise, Lots& lots) {
  const int rating = static_cast<int>(std::lround(mean + noise * lots.normal()));
  return std::clamp(rating, design.scale_least, design.scale_most);
}

/// A head that moves to both sides as far as by chance, where movement shows something.
void move_head(const StudyCondition& condition, Lots& lots, TrialRecord& record) {
  if (condition.shown.display.views_per_10cm <= 0) return;
  record.head_least_m = -0.12 * std::abs(lots.normal());
  record.head_most_m = 0.12 * std::abs(lots.normal());
}

}  // namespace

void check_effects(const StudyDesign& design, const SimulatedObservers& observers) {
  for (const SimulatedEffect& effect : observers.effects) {
    if (!effect.condition.empty()) continue;
    const auto factor = std::ranges::find(design.factors, effect.factor, &StudyFactor::name);
    if (factor == design.factors.end())
      throw Error(ErrorKind::bad_input, fmt::format("effect: '{}' is no factor of {}", effect.factor, design.name));
    if (std::ranges::find(factor->levels, effect.level, &FactorLevel::name) == factor->levels.end())
      throw Error(ErrorKind::bad_input, fmt::format("effect: '{}' is no level of {}", effect.level, effect.factor));
  }
}

SubjectRecords simulate_subject(const StudyDesign& design, const SimulatedObservers& observers, int subject,
                                std::uint64_t seed) {
  Lots lots({seed, static_cast<std::uint64_t>(subject), 0x7375626a});
  const double own_s =
      std::max(5 * shortest_s, observers.response_time_s + observers.between_subjects_s * lots.normal());
  const std::vector<StudyCondition> conditions = conditions_of_group(design, group_of_subject(design, subject));
  std::vector<SimulatedEffect> effects;
  for (const StudyCondition& condition : conditions) effects.push_back(sum_of_effects(design, observers, condition));
  SubjectRecords records{.number = subject};
  for (const PlannedTrial& planned : plan_trials(design, subject)) {
    if (planned.practice) continue;
    const SimulatedEffect& effect = effects[static_cast<std::size_t>(planned.condition)];
    TrialRecord record{
        .trial = static_cast<int>(records.trials.size()) + 1, .condition = planned.condition, .item = planned.item};
    const double mean_s =
        std::max(2 * shortest_s, own_s + effect.seconds + item_seconds(observers, planned.item, seed));
    record.response_time_s = std::max(shortest_s, log_normal(mean_s, observers.noise_s, lots));
    const bool lapse = lots.unit() < observers.lapses;
    record.response = design.task == StudyTask::path
                          ? answer_path(design, planned.item, lapse ? 0.5 : observers.correct + effect.share, lots)
                          : answer_rating(design, observers.rating + effect.share,
                                          effect.rating_noise > 0 ? effect.rating_noise : observers.rating_noise, lots);
    move_head(conditions[static_cast<std::size_t>(planned.condition)], lots, record);
    records.trials.push_back(record);
  }
  for (const StudyQuestion& question : design.questions)
    records.answers.emplace_back(question.name, question.least + lots.below(question.most - question.least + 1));
  return records;
}

StudyData simulate_study(const StudyDesign& design, const SimulatedObservers& observers, int subjects,
                         std::uint64_t seed) {
  check_effects(design, observers);
  StudyData data{.design = design, .simulated = true};
  data.subjects.resize(static_cast<std::size_t>(subjects));
  for (int subject = 0; subject < subjects; ++subject)
    data.subjects[static_cast<std::size_t>(subject)] = simulate_subject(design, observers, subject, seed);
  return data;
}

std::vector<SimulatedPower> simulated_power(const StudyDesign& design, const SimulatedObservers& observers,
                                            const PowerOptions& options) {
  check_effects(design, observers);
  std::vector<std::vector<SimulatedPower>> found(static_cast<std::size_t>(options.studies));
  tbb::parallel_for(0, options.studies, [&](int study) {
    const std::uint64_t seed = hash_keys({options.seed, static_cast<std::uint64_t>(study)});
    const StudyAnalysis analysis =
        analyse_study(simulate_study(design, observers, options.subjects, seed), options.analysis);
    for (const MeasureAnalysis& measure : analysis.measures)
      for (const AnovaEffect& effect : measure.by_subjects.effects)
        found[static_cast<std::size_t>(study)].push_back({measure.name, effect.name, effect.p < 0.05 ? 1.0 : 0.0});
  });
  std::vector<SimulatedPower> power = found.front();
  for (SimulatedPower& one : power) one.share = 0;
  for (const std::vector<SimulatedPower>& of_study : found)
    for (std::size_t i = 0; i < std::min(power.size(), of_study.size()); ++i)
      power[i].share += of_study[i].share / static_cast<double>(options.studies);
  return power;
}

}  // namespace wheatstone
