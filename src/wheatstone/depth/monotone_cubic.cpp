#include "wheatstone/depth/monotone_cubic.h"

#include <algorithm>
#include <vector>

namespace wheatstone {

void choose_slopes(std::span<CurvePoint> points) {
  const std::size_t n = points.size();
  if (n < 2) return;
  std::vector<double> length(n - 1), secant(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    length[k] = points[k + 1].at - points[k].at;
    secant[k] = (points[k + 1].value - points[k].value) / length[k];
  }
  points.front().slope = secant.front();
  points.back().slope = secant.back();
  for (std::size_t k = 1; k + 1 < n; ++k) {
    points[k].slope = 0;
    if (secant[k - 1] * secant[k] <= 0) continue;
    const double before = 2 * length[k] + length[k - 1];
    const double after = length[k] + 2 * length[k - 1];
    points[k].slope = (before + after) / (before / secant[k - 1] + after / secant[k]);
  }
}

double value_between(const CurvePoint& from, const CurvePoint& to, double share) {
  const double length = to.at - from.at;
  const double rest = 1 - share;
  return rest * rest * ((1 + 2 * share) * from.value + share * length * from.slope) +
         share * share * ((1 + 2 * rest) * to.value - rest * length * to.slope);
}

double value_at(std::span<const CurvePoint> points, double at) {
  const auto next = std::ranges::upper_bound(points, at, {}, &CurvePoint::at);
  if (next == points.begin()) return points.front().value;
  if (next == points.end()) return points.back().value;
  const CurvePoint& before = *(next - 1);
  return value_between(before, *next, (at - before.at) / (next->at - before.at));
}

}  // namespace wheatstone
