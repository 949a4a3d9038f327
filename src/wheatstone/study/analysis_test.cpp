#include "wheatstone/study/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "throws_error.h"
#include "wheatstone/study/analysis_report.h"
#include "wheatstone/study/simulate.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::analysis_test {

using testing::ElementsAre;
using testing::HasSubstr;

const StudyDesign& first_experiment() {
  static const StudyDesign design = load_study_design("path-searching-1");
  return design;
}

/// Observers who are always right, and whose times differ by single answers only.
SimulatedObservers even_observers() {
  return {.between_subjects_s = 3, .between_items_s = 0, .noise_s = 10.8, .correct = 1, .lapses = 0};
}

const AnovaEffect& effect_of(const AnovaResult& result, const std::string& name) {
  return *std::ranges::find(result.effects, name, &AnovaEffect::name);
}

TEST(Analysis, HasTheThesisDegreesOfFreedom) {
  const StudyAnalysis first = analyse_study(simulate_study(first_experiment(), even_observers(), 39, 1));
  const MeasureAnalysis& time = first.measures[0];
  EXPECT_EQ(effect_of(time.by_subjects, "depth_cm").df_error, 38);
  EXPECT_EQ(effect_of(time.by_items, "depth_cm").df_error, 77);
  EXPECT_EQ(effect_of(time.by_subjects, "views_per_10cm").df_error, 190);
  EXPECT_EQ(effect_of(time.by_items, "views_per_10cm").df_error, 385);
  EXPECT_EQ(effect_of(time.by_items, "depth_cm:views_per_10cm").df_error, 385);
  const StudyDesign second = load_study_design("path-searching-2");
  const StudyAnalysis analysis = analyse_study(simulate_study(second, even_observers(), 15, 1));
  EXPECT_EQ(effect_of(analysis.measures[1].by_subjects, "views_per_10cm").df_error, 56);
  EXPECT_EQ(effect_of(analysis.measures[1].by_items, "views_per_10cm").df_error, 396);
}

TEST(Analysis, DegreesOfFreedomAreThoseThatTheDesignAnnounces) {
  const StudyAnalysis analysis = analyse_study(simulate_study(first_experiment(), even_observers(), 39, 2));
  for (const DesignEffect& announced : degrees_of_freedom(first_experiment())) {
    EXPECT_EQ(effect_of(analysis.measures[0].by_subjects, announced.name).df_error, announced.error_subjects);
    EXPECT_EQ(effect_of(analysis.measures[0].by_items, announced.name).df_error, announced.error_items);
  }
}

TEST(Analysis, MeansAreThoseOfSubjects) {
  StudyData data = simulate_study(first_experiment(), even_observers(), 2, 3);
  for (SubjectRecords& subject : data.subjects)
    for (TrialRecord& record : subject.trials) record.response_time_s = 10 + 4 * subject.number + record.condition;
  const StudyAnalysis analysis = analyse_study(data);
  const ConditionMean& mean = analysis.measures[0].means[3];
  EXPECT_EQ(mean.condition, "depth_cm=2,views_per_10cm=6");
  EXPECT_DOUBLE_EQ(mean.mean, 15);
  EXPECT_DOUBLE_EQ(mean.deviation, std::sqrt(8));
  EXPECT_DOUBLE_EQ(mean.standard_error, 2);
  EXPECT_EQ(analysis.measures[0].comparisons[0].name, "depth_cm=2 - depth_cm=10");
  EXPECT_DOUBLE_EQ(analysis.measures[0].comparisons[0].by_subjects.mean, -6);
  EXPECT_EQ(analysis.measures[0].comparisons[1].name, "depth_cm=2 - flat");
}

TEST(Analysis, WrongAnswersAndOutliersDoNotCountAsResponseTimes) {
  StudyData data = simulate_study(first_experiment(), even_observers(), 1, 3);
  for (TrialRecord& record : data.subjects[0].trials) record.response_time_s = 10 + record.trial % 2;
  data.subjects[0].trials[7].response_time_s = 500;
  data.subjects[0].trials[9].response = 1 - data.subjects[0].trials[9].response;
  data.subjects[0].trials[9].response_time_s = 900;
  const StudyAnalysis analysis = analyse_study(data);
  EXPECT_EQ(analysis.wrong_answers, 1);
  EXPECT_EQ(analysis.outliers, 1);
  for (const ConditionMean& mean : analysis.measures[0].means) EXPECT_LE(mean.mean, 11);
  EXPECT_THAT(analysis.outlier_rule, HasSubstr("more than 3 standard deviations from its subject's mean"));
  EXPECT_EQ(analyse_study(data, {.outlier_deviations = 0}).outliers, 0);
}

TEST(Analysis, SubjectsWithoutACellAreLeftOutAndNamed) {
  StudyData data = simulate_study(first_experiment(), even_observers(), 8, 3);
  std::erase_if(data.subjects[2].trials, [](const TrialRecord& record) { return record.condition == 4; });
  const StudyAnalysis analysis = analyse_study(data);
  EXPECT_THAT(analysis.measures[0].by_subjects.left_out, ElementsAre("sub-03"));
  EXPECT_THAT(analysis.unfinished, ElementsAre("sub-03"));
  EXPECT_EQ(analysis.measures[0].by_subjects.units, 7);
}

TEST(Analysis, HeadMovementIsABoxOfFiveNumbers) {
  StudyData data = simulate_study(first_experiment(), even_observers(), 1, 3);
  int count = 0;
  for (TrialRecord& record : data.subjects[0].trials)
    if (record.condition == 2) {
      record.head_least_m = -0.1;
      record.head_most_m = count++ == 0 ? 0.9 : 0.01 * count;
    }
  const StudyAnalysis analysis = analyse_study(data);
  const HeadMovement& box = analysis.head_movement[1];
  EXPECT_EQ(box.condition, "depth_cm=2,views_per_10cm=4");
  EXPECT_DOUBLE_EQ(box.median, 0.145);
  EXPECT_THAT(box.outside, ElementsAre(1.0));
  EXPECT_DOUBLE_EQ(box.most, 0.16);
}

TEST(Analysis, RatingsAreAveraged) {
  const StudyDesign design = load_study_design("painting-comfort");
  SimulatedObservers observers;
  observers.effects = {{"version", "inconsistent", 0, -1.5}};
  const StudyAnalysis analysis = analyse_study(simulate_study(design, observers, 30, 1));
  EXPECT_EQ(analysis.measures[0].name, "rating");
  EXPECT_LT(analysis.measures[0].means[2].mean, analysis.measures[0].means[1].mean - 0.8);
  EXPECT_LT(effect_of(analysis.measures[0].by_subjects, "version").p, 1e-6);
}

TEST(Analysis, OfEqualAnswersHasNoVarianceAndSaysSo) {
  SimulatedObservers observers = even_observers();
  observers.between_subjects_s = observers.noise_s = 0;
  for (const char* name : {"path-searching-1", "path-searching-2"}) {
    const StudyDesign design = load_study_design(name);
    const StudyData data = simulate_study(design, observers, design.subjects, 1);
    const StudyAnalysis analysis = analyse_study(data);
    for (const MeasureAnalysis& measure : analysis.measures)
      for (const AnovaEffect& effect : measure.by_subjects.effects) EXPECT_TRUE(std::isnan(effect.p)) << effect.name;
    const auto tables = analysis_tables(data, analysis);
    EXPECT_THAT(tables.at(1).second, HasSubstr("\tn/a\t"));
    EXPECT_THAT(analysis_page(data, analysis), testing::Not(HasSubstr("nan")));
  }
}

TEST(Analysis, MeansThatDifferByRoundingHaveAFigure) {
  StudyData data = simulate_study(first_experiment(), even_observers(), 2, 3);
  for (SubjectRecords& subject : data.subjects)
    for (TrialRecord& record : subject.trials) record.response_time_s = 18 + 4e-15 * (record.condition % 2);
  EXPECT_THAT(analysis_page(data, analyse_study(data)), HasSubstr("</svg>"));
}

TEST(Analysis, AStudyWithoutTrialsIsRefused) {
  expect_error(ErrorKind::bad_input, "no trials yet", [] { analyse_study({.design = first_experiment()}); });
}

TEST(Simulation, SameSeedSameAnswers) {
  const auto times = [](std::uint64_t seed) {
    std::vector<double> all;
    for (const TrialRecord& record : simulate_subject(first_experiment(), {}, 3, seed).trials)
      all.push_back(record.response_time_s);
    return all;
  };
  EXPECT_EQ(times(1), times(1));
  EXPECT_NE(times(1), times(2));
}

TEST(Simulation, AnEffectOfNoFactorIsRefused) {
  const auto simulate = [](const char* factor, const char* level) {
    return [=] { simulate_study(first_experiment(), {.effects = {{factor, level, 1, 0}}}, 1, 1); };
  };
  expect_error(ErrorKind::bad_input, "'depth' is no factor of path-searching-1", simulate("depth", "2"));
  expect_error(ErrorKind::bad_input, "'3' is no level of depth_cm", simulate("depth_cm", "3"));
}

double share_of(const std::vector<SimulatedPower>& power, const std::string& effect) {
  return std::ranges::find(power, effect, &SimulatedPower::effect)->share;
}

/// The thesis's effect of depth: 18.30 s at 2 cm and 17.06 s at 10 cm (table 3.1), F1(1, 38) = 9.20.
SimulatedObservers with_effect_of_depth() {
  SimulatedObservers observers = even_observers();
  observers.effects = {{"depth_cm", "10", -1.24, 0}};
  return observers;
}

/// Of 36 answers at each depth of each of 39 subjects.
double noncentrality() { return 39 * 1.24 * 1.24 / (2 * 10.8 * 10.8 / 36); }

TEST(Simulation, FewStudiesFindAnEffectThatIsNotThere) {
  const auto power = simulated_power(load_study_design("path-searching-2"), even_observers(),
                                     {.subjects = 15, .studies = 100, .seed = 5});
  EXPECT_LT(share_of(power, "views_per_10cm"), 0.11);
}

TEST(SimulationLong, TwoThousandStudiesWithoutEffectRejectInThreeToSevenPercent) {
  for (const char* name : {"path-searching-1", "path-searching-2"}) {
    const StudyDesign design = load_study_design(name);
    for (const SimulatedPower& effect :
         simulated_power(design, even_observers(), {.subjects = design.subjects, .studies = 2000, .seed = 11})) {
      if (effect.measure != "response_time") continue;  // all answers are right
      EXPECT_GT(effect.share, 0.03) << name << " " << effect.effect;
      EXPECT_LT(effect.share, 0.07) << name << " " << effect.effect;
    }
  }
}

TEST(SimulationLong, TwoThousandStudiesFindTheThesisEffectOfDepthAsOftenAsTheNoncentralFSays) {
  const auto power =
      simulated_power(first_experiment(), with_effect_of_depth(),
                      {.subjects = 39, .studies = 2000, .seed = 12, .analysis = {.outlier_deviations = 0}});
  EXPECT_NEAR(share_of(power, "depth_cm"), power_of_f(1, 38, noncentrality()), 0.03);
}

}  // namespace wheatstone::analysis_test
