#include "wheatstone/study/published.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// Each number's place from the least, 1; numbers that are the same share their mean place.
std::vector<double> ranks_of(const std::vector<double>& numbers) {
  std::vector<double> ranks;
  for (const double number : numbers) {
    const auto below = std::ranges::count_if(numbers, [number](double other) { return other < number; });
    const auto same = std::ranges::count(numbers, number);
    ranks.push_back(static_cast<double>(below) + (static_cast<double>(same) + 1) / 2);
  }
  return ranks;
}

/// Pearson's correlation of ranks (Spearman 1904).
double rank_correlation(const std::vector<double>& first, const std::vector<double>& second) {
  const std::vector<double> a = ranks_of(first), b = ranks_of(second);
  const double middle = (static_cast<double>(a.size()) + 1) / 2;
  double together = 0, of_first = 0, of_second = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    together += (a[i] - middle) * (b[i] - middle);
    of_first += (a[i] - middle) * (a[i] - middle);
    of_second += (b[i] - middle) * (b[i] - middle);
  }
  return of_first > 0 && of_second > 0 ? together / std::sqrt(of_first * of_second) : not_available;
}

}  // namespace

std::vector<PublishedComparison> beside_published(const StudyDesign& design, const StudyAnalysis& analysis) {
  std::vector<PublishedComparison> comparisons;
  for (const MeasureAnalysis& measure : analysis.measures) {
    PublishedComparison comparison{.measure = measure.name};
    std::vector<double> ours, theirs;
    for (const PublishedMean& published : design.published) {
      const auto found = std::ranges::find(measure.means, published.condition, &ConditionMean::condition);
      if (published.measure != measure.name || found == measure.means.end() || std::isnan(found->mean)) continue;
      comparison.conditions.push_back({published.condition, found->mean, published.mean, published.deviation,
                                       (found->mean - published.mean) / published.deviation});
      ours.push_back(found->mean);
      theirs.push_back(published.mean);
    }
    if (ours.empty()) continue;
    comparison.order = rank_correlation(ours, theirs);
    comparisons.push_back(std::move(comparison));
  }
  if (comparisons.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has no published means of what was measured, expected [published.{}] in its design",
                            design.name, analysis.measures.front().name));
  return comparisons;
}

}  // namespace wheatstone
