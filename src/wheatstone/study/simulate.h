#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wheatstone/study/analysis.h"
#include "wheatstone/study/study_data.h"

namespace wheatstone {

/// What one level of a factor, or one condition, does to observers.
struct SimulatedEffect {
  std::string factor, level;
  double seconds = 0;          ///< added to response times
  double share = 0;            ///< added to the probability of a right answer, or to ratings
  double rating_noise = 0;     ///< of this condition's ratings; 0: that of all
  std::string condition = {};  ///< by its name, in place of a factor's level
};

/// Observers who are none: their response times and answers are drawn by lot.
struct SimulatedObservers {
  double response_time_s = 18;    ///< mean (Hassaine 2010, table 3.1)
  double between_subjects_s = 6;  ///< standard deviation of subjects' means
  double between_items_s = 1;     ///< of items
  double noise_s = 10;            ///< of single response times, which have a log-normal distribution
  double correct = 0.9;           ///< probability of a right answer
  double rating = 3.5;            ///< mean, and deviation of single ratings
  double rating_noise = 0.9;
  double lapses = 0.02;  ///< share of trials that are answered by chance
  std::vector<SimulatedEffect> effects;
};

/// Throws Error{bad_input} where an effect's factor or level is not in the design.
void check_effects(const StudyDesign& design, const SimulatedObservers& observers);

/// One observer's answers to all trials of its row of the design.
SubjectRecords simulate_subject(const StudyDesign& design, const SimulatedObservers& observers, int subject,
                                std::uint64_t seed);

/// The whole study by so many observers.
StudyData simulate_study(const StudyDesign& design, const SimulatedObservers& observers, int subjects,
                         std::uint64_t seed);

/// How often simulated studies find an effect at the 5 % level by subjects.
struct SimulatedPower {
  std::string measure, effect;
  double share = 0;
};

struct PowerOptions {
  int subjects = 0;
  int studies = 1000;
  std::uint64_t seed = 1;
  AnalysisOptions analysis;
};

/// Simulates and analyses that many studies, on all threads.
std::vector<SimulatedPower> simulated_power(const StudyDesign& design, const SimulatedObservers& observers,
                                            const PowerOptions& options);

}  // namespace wheatstone
