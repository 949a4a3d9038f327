#include "head_filter.h"

#include <cmath>
#include <numbers>

namespace wheatstone::viewer {
namespace {

/// The share of a new value in a mean that forgets with a time constant.
double share_of_new(double passed_s, double constant_s) {
  return constant_s > 0 ? passed_s / (passed_s + constant_s) : 1;
}

}  // namespace

double HeadFilter::add(double position, double time_s, const HeadFilterOptions& options) {
  constexpr double speed_constant_s = 0.05;
  // Cut-off in hertz that an eye separation a second adds.
  constexpr double beta = 2;
  if (!before_ || time_s <= before_->time_s) {
    if (!before_) before_ = Measured{time_s, position, position, 0};
    return before_->steadied;
  }
  Measured now{time_s, position, 0, 0};
  const double passed_s = time_s - before_->time_s;
  const double speed = (position - before_->position) / passed_s;
  now.speed = std::lerp(before_->speed, speed, share_of_new(passed_s, speed_constant_s));
  double constant_s = options.smoothing_s;
  if (constant_s > 0) {
    const double cut_off_hz = 1 / (2 * std::numbers::pi * constant_s) + beta * std::abs(now.speed);
    constant_s = 1 / (2 * std::numbers::pi * cut_off_hz);
  }
  now.steadied = std::lerp(before_->steadied, position, share_of_new(passed_s, constant_s));
  before_ = now;
  return now.steadied + now.speed * options.prediction_s;
}

}  // namespace wheatstone::viewer
