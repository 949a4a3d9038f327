#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace wheatstone {

/// Values of units (subjects, or items) in the cells of a design.
struct AnovaData {
  struct Factor {
    std::string name;
    int levels = 2;
    bool between = false;  ///< a unit has one of its levels only
  };
  std::vector<Factor> factors;
  std::vector<std::string> units;           ///< their names
  std::vector<std::vector<int>> groups;     ///< of each unit: its level of each factor between
  std::vector<std::vector<double>> values;  ///< of each unit: the cells of the factors within, the last one's levels in
                                            ///< turn first; NaN where there is none
};

/// How far the cells' differences are from having one variance, and the tests that allow for it. Mauchly's p is NaN
/// where some difference has no variance.
struct Sphericity {
  double mauchly_w = 1, mauchly_p = 1;
  double greenhouse_geisser = 1, greenhouse_geisser_p = 1;  ///< ε, and p of F with it
  double huynh_feldt = 1, huynh_feldt_p = 1;                ///< may exceed 1, which is then taken for p
};

/// Where the units' values have no variance, up to rounding, F, p and both η² are NaN.
struct AnovaEffect {
  std::string name;  ///< "depth_cm:views_per_10cm"
  double df_effect = 0, df_error = 0;
  double f = 0, p = 1;
  double partial_eta_squared = 0;
  double generalised_eta_squared = 0;    ///< Olejnik & Algina 2003, of factors that are all set by the experimenter
  std::optional<Sphericity> sphericity;  ///< of effects with two or more degrees of freedom within units
};

struct AnovaResult {
  std::vector<AnovaEffect> effects;
  int units = 0;
  std::vector<std::string> left_out;  ///< units with a missing cell
};

/// Analysis of variance with factors within and between units, with sums of squares of type III, as R's package afex
/// does it. Units with a missing cell are left out. No effects where too few units are left.
AnovaResult repeated_measures_anova(const AnovaData& data);

/// min F′ of an effect by subjects (F1) and by items (F2): a lower bound of what holds of both (Clark 1973). NaN where
/// either is.
struct MinF {
  double f = 0, df_effect = 0, df_error = 0, p = 1;
};
MinF min_f_prime(const AnovaEffect& by_subjects, const AnovaEffect& by_items);

/// Student's t of paired values: pairs with a NaN do not count. t, p and d are NaN where the differences have no
/// variance, up to rounding.
struct PairedT {
  double mean = 0;  ///< of first − second
  double standard_error = 0;
  double t = 0, df = 0, p = 1;  ///< two-sided
  double cohens_dz = 0;
};
PairedT paired_t(std::span<const double> first, std::span<const double> second);

/// Holm 1979: p values for several tests at once, in the order of the tests. Those that are NaN do not count.
std::vector<double> holm_corrected(const std::vector<double>& p);

/// Probability that an F test at the 5 % level finds an effect of this noncentrality λ.
double power_of_f(double df_effect, double df_error, double noncentrality);

}  // namespace wheatstone
