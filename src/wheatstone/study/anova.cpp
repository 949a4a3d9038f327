#include "wheatstone/study/anova.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace wheatstone {
namespace {

using Matrix = Eigen::MatrixXd;
using Factors = std::vector<AnovaData::Factor>;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Sums of squares below this share of those of the values are what rounding leaves of none.
constexpr double rounding_share = 1e-22;

/// p of an F at least so large by chance; NaN of an F that is not available.
double upper_tail(double f, double df_effect, double df_error) {
  if (!std::isfinite(f)) return not_known;
  if (f <= 0) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(df_effect, df_error), f));
}

Matrix kronecker(const Matrix& a, const Matrix& b) {
  Matrix product(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      product.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
  return product;
}

/// Contrasts of levels, orthogonal and of length 1 (Helmert's).
Matrix contrasts(int levels) {
  Matrix matrix = Matrix::Zero(levels, levels - 1);
  for (int j = 0; j + 1 < levels; ++j) {
    for (int i = 0; i <= j; ++i) matrix(i, j) = 1;
    matrix(j + 1, j) = -(j + 1);
    matrix.col(j).normalize();
  }
  return matrix;
}

/// What cells of the factors within are summed to for an effect of some of them: its contrasts.
Matrix contrasts_within(const Factors& factors, std::uint32_t of_effect) {
  Matrix all = Matrix::Ones(1, 1);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i].between) continue;
    const int levels = factors[i].levels;
    all = kronecker(all, (of_effect >> i & 1) != 0 ? contrasts(levels)
                                                   : Matrix(Matrix::Constant(levels, 1, 1 / std::sqrt(levels))));
  }
  return all;
}

/// The columns of the model between units that stand for an effect, with codes that sum to 0 over levels.
Matrix columns_between(const Factors& factors, const std::vector<std::vector<int>>& groups, std::uint32_t of_effect) {
  Matrix columns = Matrix::Ones(static_cast<Eigen::Index>(groups.size()), 1);
  std::size_t between = 0;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (!factors[i].between) continue;
    const std::size_t which = between++;
    if ((of_effect >> i & 1) == 0) continue;
    const Matrix codes = contrasts(factors[i].levels);
    Matrix product(columns.rows(), columns.cols() * codes.cols());
    for (Eigen::Index unit = 0; unit < columns.rows(); ++unit)
      product.row(unit) = kronecker(columns.row(unit), codes.row(groups[static_cast<std::size_t>(unit)][which]));
    columns = product;
  }
  return columns;
}

bool are_between(const Factors& factors, std::uint32_t effect) {
  for (std::size_t i = 0; i < factors.size(); ++i)
    if ((effect >> i & 1) != 0 && !factors[i].between) return false;
  return true;
}

/// The part of an effect's factors that are within, or between.
std::uint32_t part_of(const Factors& factors, std::uint32_t effect, bool between) {
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (factors[i].between != between) effect &= ~(1u << i);
  return effect;
}

/// The model of what differs between units, of all its effects one beside the other.
struct BetweenModel {
  Matrix design, inverse;                  ///< X and (XᵀX)⁻¹
  std::vector<Eigen::Index> first, count;  ///< columns of each effect, by its bits
  bool has_inverse = false;                ///< no group is without units
};

BetweenModel between_model(const Factors& factors, const std::vector<std::vector<int>>& groups) {
  const std::size_t effects = std::size_t{1} << factors.size();
  BetweenModel model{.design = Matrix(static_cast<Eigen::Index>(groups.size()), 0)};
  model.first.assign(effects, 0);
  model.count.assign(effects, 0);
  for (std::uint32_t effect = 0; effect < effects; ++effect) {
    if (!are_between(factors, effect)) continue;
    const Matrix columns = columns_between(factors, groups, effect);
    model.first[effect] = model.design.cols();
    model.count[effect] = columns.cols();
    Matrix wider(model.design.rows(), model.design.cols() + columns.cols());
    wider << model.design, columns;
    model.design = wider;
  }
  const Eigen::FullPivLU<Matrix> squared(model.design.transpose() * model.design);
  model.has_inverse = squared.isInvertible();
  if (model.has_inverse) model.inverse = squared.inverse();
  return model;
}

/// Mauchly 1940, with the second-order approximation of p. The last term of w2 has the number of all cells, as R does.
void add_mauchly(const Matrix& error, double df, double cells, Sphericity& sphericity) {
  const double k = static_cast<double>(error.rows());
  const Eigen::FullPivLU<Matrix> relative(error * (k / error.trace()));
  const double w = relative.isInvertible() ? std::clamp(relative.determinant(), 0.0, 1.0) : 0;
  const double rho = 1 - (2 * k * k + k + 2) / (6 * k * df);
  const double w2 =
      (k + 2) * (k - 1) * (k - 2) * (2 * k * k * k + 6 * k * k + 3 * cells + 2) / (288 * std::pow(df * k * rho, 2));
  const double z = -df * rho * std::log(w);
  const double freedom = k * (k + 1) / 2 - 1;
  sphericity.mauchly_w = w;
  if (!std::isfinite(z)) sphericity.mauchly_p = not_known;
  if (!(z > 0) || !std::isfinite(z)) return;
  const auto tail = [z](double f) { return boost::math::cdf(boost::math::complement(boost::math::chi_squared(f), z)); };
  const double first = tail(freedom);
  sphericity.mauchly_p = first + w2 * (tail(freedom + 4) - first);
}

/// Greenhouse & Geisser 1959; Huynh & Feldt 1976.
std::optional<Sphericity> sphericity_of(const Matrix& error, double df, double cells, const AnovaEffect& effect) {
  if (error.rows() < 2 || df < static_cast<double>(error.rows()) || !std::isfinite(effect.f)) return {};
  Sphericity sphericity;
  const double k = static_cast<double>(error.rows());
  sphericity.greenhouse_geisser = std::pow(error.trace(), 2) / (k * (error * error).trace());
  const double gg = sphericity.greenhouse_geisser;
  sphericity.huynh_feldt = ((df + 1) * k * gg - 2) / (k * (df - k * gg));
  const double hf = std::min(1.0, sphericity.huynh_feldt);
  sphericity.greenhouse_geisser_p = upper_tail(effect.f, gg * effect.df_effect, gg * effect.df_error);
  sphericity.huynh_feldt_p = upper_tail(effect.f, hf * effect.df_effect, hf * effect.df_error);
  add_mauchly(error, df, cells, sphericity);
  return sphericity;
}

std::string effect_name(const Factors& factors, std::uint32_t effect) {
  std::string name;
  for (std::size_t i = 0; i < factors.size(); ++i)
    if ((effect >> i & 1) != 0) name += (name.empty() ? "" : ":") + factors[i].name;
  return name;
}

/// An effect before its sums of squares are set against those of all others.
struct Tested {
  AnovaEffect effect;
  double squares = 0, error_squares = 0;
  std::uint32_t within = 0;
};

Tested test_effect(const Factors& factors, const Matrix& values, const BetweenModel& model, std::uint32_t effect) {
  Tested tested;
  tested.within = part_of(factors, effect, false);
  const std::uint32_t between = part_of(factors, effect, true);
  const Matrix contrasted = values * contrasts_within(factors, tested.within);
  const Matrix coefficients = model.inverse * model.design.transpose() * contrasted;
  const Matrix residuals = contrasted - model.design * coefficients;
  const Matrix error = residuals.transpose() * residuals;
  const Matrix own = coefficients.middleRows(model.first[between], model.count[between]);
  const Matrix own_inverse =
      model.inverse.block(model.first[between], model.first[between], model.count[between], model.count[between]);
  tested.squares = (own.transpose() * own_inverse.inverse() * own).trace();
  tested.error_squares = error.trace();
  const double df = static_cast<double>(model.design.rows() - model.design.cols());
  const double k = static_cast<double>(contrasted.cols());
  AnovaEffect& result = tested.effect;
  result.name = effect_name(factors, effect);
  result.df_effect = k * static_cast<double>(model.count[between]);
  result.df_error = k * df;
  // Without variance there is nothing to compare an effect with.
  const bool varies = tested.error_squares > rounding_share * values.squaredNorm();
  result.f = varies ? tested.squares / result.df_effect / (tested.error_squares / result.df_error) : not_known;
  result.p = upper_tail(result.f, result.df_effect, result.df_error);
  result.partial_eta_squared = varies ? tested.squares / (tested.squares + tested.error_squares) : not_known;
  result.sphericity = sphericity_of(error, df, static_cast<double>(values.cols()), result);
  return tested;
}

/// The units without a missing cell.
std::vector<std::size_t> whole_units(const AnovaData& data, std::vector<std::string>& left_out) {
  std::vector<std::size_t> whole;
  for (std::size_t unit = 0; unit < data.values.size(); ++unit) {
    if (std::ranges::none_of(data.values[unit], [](double value) { return std::isnan(value); }))
      whole.push_back(unit);
    else
      left_out.push_back(data.units[unit]);
  }
  return whole;
}

}  // namespace

AnovaResult repeated_measures_anova(const AnovaData& data) {
  AnovaResult result;
  const std::vector<std::size_t> whole = whole_units(data, result.left_out);
  result.units = static_cast<int>(whole.size());
  if (whole.empty()) return result;
  Matrix values(result.units, static_cast<Eigen::Index>(data.values[whole[0]].size()));
  std::vector<std::vector<int>> groups;
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    const std::size_t unit = whole[static_cast<std::size_t>(row)];
    for (Eigen::Index cell = 0; cell < values.cols(); ++cell)
      values(row, cell) = data.values[unit][static_cast<std::size_t>(cell)];
    groups.push_back(data.groups.empty() ? std::vector<int>() : data.groups[unit]);
  }
  const BetweenModel model = between_model(data.factors, groups);
  if (values.rows() <= model.design.cols() || !model.has_inverse) return result;
  std::vector<Tested> tested;
  for (std::uint32_t effect = 1; effect < 1u << data.factors.size(); ++effect)
    tested.push_back(test_effect(data.factors, values, model, effect));
  // Each error counts once: effects with the same factors within share theirs.
  double all_errors = 0;
  for (std::uint32_t within = 0; within < 1u << data.factors.size(); ++within) {
    if (part_of(data.factors, within, false) != within) continue;
    const Matrix contrasted = values * contrasts_within(data.factors, within);
    all_errors += (contrasted - model.design * (model.inverse * model.design.transpose() * contrasted)).squaredNorm();
  }
  for (Tested& one : tested) {
    one.effect.generalised_eta_squared =
        std::isfinite(one.effect.f) ? one.squares / (one.squares + all_errors) : not_known;
    result.effects.push_back(one.effect);
  }
  return result;
}

MinF min_f_prime(const AnovaEffect& by_subjects, const AnovaEffect& by_items) {
  const double f1 = by_subjects.f, f2 = by_items.f;
  if (!std::isfinite(f1 + f2))
    return {.f = not_known, .df_effect = by_subjects.df_effect, .df_error = not_known, .p = not_known};
  if (!(f1 + f2 > 0)) return {};
  MinF result{.f = f1 * f2 / (f1 + f2), .df_effect = by_subjects.df_effect};
  result.df_error = std::pow(f1 + f2, 2) / (f1 * f1 / by_items.df_error + f2 * f2 / by_subjects.df_error);
  result.p = upper_tail(result.f, result.df_effect, result.df_error);
  return result;
}

PairedT paired_t(std::span<const double> first, std::span<const double> second) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!std::isnan(first[i] - second[i])) differences.push_back(first[i] - second[i]);
  const double n = static_cast<double>(differences.size());
  if (n < 2) return {};
  PairedT result{.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / n, .df = n - 1};
  double squares = 0, of_values = 0;
  for (const double difference : differences) squares += std::pow(difference - result.mean, 2);
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!std::isnan(first[i] - second[i])) of_values += first[i] * first[i] + second[i] * second[i];
  const double deviation = std::sqrt(squares / (n - 1));
  result.standard_error = deviation / std::sqrt(n);
  if (squares <= rounding_share * of_values) {
    result.t = result.p = result.cohens_dz = not_known;
    return result;
  }
  result.cohens_dz = result.mean / deviation;
  result.t = result.mean / result.standard_error;
  result.p = 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(result.df), std::abs(result.t)));
  return result;
}

std::vector<double> holm_corrected(const std::vector<double>& p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isnan(p[i])) order.push_back(i);
  std::ranges::sort(order, {}, [&p](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size(), not_known);
  double most = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    most = std::max(most, std::min(1.0, static_cast<double>(order.size() - rank) * p[order[rank]]));
    corrected[order[rank]] = most;
  }
  return corrected;
}

double power_of_f(double df_effect, double df_error, double noncentrality) {
  const double critical =
      boost::math::quantile(boost::math::complement(boost::math::fisher_f(df_effect, df_error), 0.05));
  if (noncentrality <= 0) return 0.05;
  return boost::math::cdf(
      boost::math::complement(boost::math::non_central_f(df_effect, df_error, noncentrality), critical));
}

}  // namespace wheatstone
