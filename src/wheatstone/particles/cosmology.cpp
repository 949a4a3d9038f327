#include <cmath>
#include <numbers>

#include "wheatstone/particles/cosmology.h"

namespace wheatstone {
namespace {

constexpr double pi = std::numbers::pi;

/// Bardeen et al. 1986, appendix G; Γ = 0.2, spectral index 0.96, not yet normalised.
double bare_power(double k) {
  const double q = k / 0.2;
  const double polynomial = 1 + 3.89 * q + std::pow(16.1 * q, 2) + std::pow(5.46 * q, 3) + std::pow(6.71 * q, 4);
  const double transfer = std::log1p(2.34 * q) / (2.34 * q) * std::pow(polynomial, -0.25);
  return std::pow(k, 0.96) * transfer * transfer;
}

/// Variance of the field seen through a window of wave numbers.
template <class WindowSquared>
double variance(WindowSquared window_squared) {
  constexpr int steps = 2000;
  constexpr double first = -4;
  constexpr double last = 2;  // decades of k
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double k = std::pow(10., first + (last - first) * (i + 0.5) / steps);
    sum += k * k * k * bare_power(k) * window_squared(k);
  }
  return sum * (last - first) / steps * std::numbers::ln10 / (2 * pi * pi);
}

double amplitude() {
  static const double value = sigma_8 * sigma_8 / variance([](double k) {
                                const double x = 8 * k;  // a ball of 8 Mpc/h
                                const double ball = 3 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
                                return ball * ball;
                              });
  return value;
}

}  // namespace

double cdm_power(double k) { return k > 0 ? amplitude() * bare_power(k) : 0; }

double expansion_rate(double scale) { return std::sqrt(matter_share / std::pow(scale, 3) + 1 - matter_share); }

double growth(double redshift) {
  const auto unscaled = [](double z) {
    const double expansion = std::pow(expansion_rate(1 / (1 + z)), 2);
    const double matter = matter_share * std::pow(1 + z, 3) / expansion;
    const double dark = (1 - matter_share) / expansion;
    return 2.5 * matter / (std::pow(matter, 4. / 7) - dark + (1 + matter / 2) * (1 + dark / 70)) / (1 + z);
  };
  return unscaled(redshift) / unscaled(0);
}

double nonlinear_scale(double redshift) {
  double least = 0.01;
  double most = 30;
  for (int i = 0; i < 40; ++i) {
    const double scale = std::sqrt(least * most);
    const double here = std::pow(growth(redshift), 2) * amplitude() *
                        variance([scale](double k) { return std::exp(-k * k * scale * scale); });
    (here > 1 ? least : most) = scale;
  }
  return std::sqrt(least * most);
}

}  // namespace wheatstone
