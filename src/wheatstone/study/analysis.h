#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/study/anova.h"
#include "wheatstone/study/study_data.h"

namespace wheatstone {

struct AnalysisOptions {
  /// Response times farther than this many standard deviations from a subject's mean are left out; 0: none are.
  double outlier_deviations = 3;
};

/// A condition's mean over subjects, each of whom counts once.
struct ConditionMean {
  std::string condition;
  double mean = not_available, deviation = not_available, standard_error = not_available;
  int subjects = 0;
};

/// Two levels of a factor, or one and a control condition, over all other factors.
struct PlannedComparison {
  std::string name;
  PairedT by_subjects, by_items;
  double holm_subjects = 1, holm_items = 1;  ///< p, corrected over the comparisons of one factor
};

/// What was measured, and what became of it.
struct MeasureAnalysis {
  std::string name;  ///< "response_time", "percent_correct" or "rating"
  std::string text, unit;
  std::vector<ConditionMean> means;
  AnovaResult by_subjects, by_items;  ///< F1 and F2
  std::vector<MinF> min_f;            ///< of the effects, in their order; empty where either is missing
  std::vector<PlannedComparison> comparisons;
};

/// The five numbers of a box plot, in m. Whiskers end at the farthest value within 1.5 times the box.
struct HeadMovement {
  std::string condition;
  double least = 0, lower_quartile = 0, median = 0, upper_quartile = 0, most = 0;
  std::vector<double> outside;
  int trials = 0;
};

struct QuestionMean {
  std::string name;
  double mean = 0, deviation = 0;
  int subjects = 0;
};

struct StudyAnalysis {
  std::vector<MeasureAnalysis> measures;
  std::vector<HeadMovement> head_movement;  ///< of conditions in which heads were followed
  std::vector<QuestionMean> questions;
  int subjects = 0, trials = 0;             ///< of subjects with trials
  std::vector<std::string> unfinished;      ///< subjects with trials or questions left to answer
  std::vector<std::string> without_trials;  ///< subjects that are listed, and do not count: there are no trials of them
  int wrong_answers = 0, outliers = 0;      ///< whose response times do not count
  std::string outlier_rule;                 ///< in words
};

/// Analyses all that there is, as Hassaine 2010, 3.2.3 does. Throws Error{bad_input} where there are no trials.
StudyAnalysis analyse_study(const StudyData& all, const AnalysisOptions& options = {});

}  // namespace wheatstone
