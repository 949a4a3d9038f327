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

double normal_cumulative(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.)); }

/// Mean and deviation of ratings that are drawn from a normal distribution, rounded, and kept on the scale.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread on_scale(const StudyDesign& design, const Spread& drawn) {
  double mean = 0, square = 0, below = 0;
  for (int rating = design.scale_least; rating <= design.scale_most; ++rating) {
    const double up_to =
        rating == design.scale_most ? 1 : normal_cumulative((rating + 0.5 - drawn.mean) / drawn.deviation);
    mean += rating * (up_to - below);
    square += rating * rating * (up_to - below);
    below = up_to;
  }
  return {mean, std::sqrt(std::max(square - mean * mean, 0.))};
}

/// What is to be drawn from, so that ratings on the scale are spread so.
Spread drawn_for(const StudyDesign& design, const Spread& wanted) {
  Spread drawn = wanted;
  constexpr int steps = 300;
  constexpr double least = 0.05, most = 10;
  for (int step = 0; step < steps; ++step) {
    const Spread made = on_scale(design, drawn);
    drawn.mean += (wanted.mean - made.mean) / 2;
    drawn.deviation =
        std::clamp(drawn.deviation * std::sqrt(wanted.deviation / std::max(made.deviation, least)), least, most);
  }
  return drawn;
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

SimulatedObservers observers_as_published(const StudyDesign& design, SimulatedObservers observers) {
  if (design.published.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has no published means, expected [published.MEASURE] in its design", design.name));
  observers.lapses = 0;  // the published means have theirs
  for (const PublishedMean& published : design.published) {
    SimulatedEffect effect{.condition = published.condition};
    if (published.measure == "response_time") {
      effect.seconds = published.mean - observers.response_time_s;
    } else if (published.measure == "percent_correct") {
      effect.share = published.mean / 100 - observers.correct;
    } else {
      const Spread drawn = drawn_for(design, {published.mean, published.deviation});
      effect.share = drawn.mean - observers.rating;
      effect.rating_noise = drawn.deviation;
    }
    observers.effects.push_back(effect);
  }
  return observers;
}

}  // namespace wheatstone
