#pragma once

#include <string>
#include <vector>

#include "wheatstone/study/analysis.h"
#include "wheatstone/study/simulate.h"

namespace wheatstone {

/// A condition's mean over subjects beside the published one, both in the measure's unit.
struct BesidePublished {
  std::string condition;
  double mean = 0, published = 0;
  double published_deviation = 0;  ///< over subjects
  double off = 0;                  ///< how far the mean lies above the published one, in published deviations
};

/// A measure of a study beside what was published.
struct PublishedComparison {
  std::string measure;
  std::vector<BesidePublished> conditions;
  double order = not_available;  ///< Spearman's rank correlation of the conditions' means; needs means that differ
};

/// The measures and conditions of which both are known. Throws Error{bad_input} where the design has no published means
/// of what was measured.
std::vector<PublishedComparison> beside_published(const StudyDesign& design, const StudyAnalysis& analysis);

/// Observers whose answers have the published means of the design, and of ratings their deviations, too; the rest is as
/// given. Throws Error{bad_input} where the design has none.
SimulatedObservers observers_as_published(const StudyDesign& design, SimulatedObservers observers);

}  // namespace wheatstone
