#include "wheatstone/study/anova.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace wheatstone::anova_test {

using testing::ElementsAre;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What afex says of an effect: df, df of the error, F, p, generalised and partial η², W, its p, ε and p twice.
struct Reference {
  int set;
  std::string effect;
  std::array<double, 12> values;
};
const std::vector<Reference> references{
#include "anova_reference.inc"
};

/// A data set as in anova_reference.R.
struct Shape {
  std::vector<int> within;
  int subjects;
  std::map<std::string, std::vector<int>> groups = {};  ///< from 0
  std::vector<std::array<int, 2>> missing = {};         ///< subject and cell, from 0
};

std::vector<int> repeated(const std::vector<int>& counts) {
  std::vector<int> groups;
  for (int group = 0; group < std::ssize(counts); ++group)
    groups.insert(groups.end(), static_cast<std::size_t>(counts[static_cast<std::size_t>(group)]), group);
  return groups;
}

std::vector<int> alternating(int count) {
  std::vector<int> groups;
  for (int i = 0; i < count; ++i) groups.push_back(i % 2);
  return groups;
}

std::vector<Shape> shapes() {
  return {{{3}, 10},
          {{2, 3}, 12},
          {{4}, 8, {}, {{1, 2}, {6, 0}}},
          {{2, 2, 3}, 9},
          {{3}, 12, {{"G", alternating(12)}}},
          {{2, 3}, 16, {{"G", repeated({4, 5, 7})}}},
          {{3}, 20, {{"G", alternating(20)}, {"H", repeated({10, 10})}}, {{3, 1}, {4, 0}, {10, 2}}},
          {{5}, 15},
          {{2, 6}, 13, {}, {{12, 11}}},
          {{2}, 6}};
}

/// Park and Miller's generator.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = 16807 * state_ % 2147483647;
    return static_cast<double>(state_) / 2147483647;
  }

 private:
  std::uint64_t state_;
};

AnovaData data_of(int number, const Shape& shape) {
  AnovaData data;
  int cells = 1;
  for (const auto& [name, groups] : shape.groups)
    data.factors.push_back({name, *std::ranges::max_element(groups) + 1, true});
  for (std::size_t i = 0; i < shape.within.size(); ++i) {
    data.factors.push_back({std::string(1, static_cast<char>('A' + i)), shape.within[i]});
    cells *= shape.within[i];
  }
  Draws draw(1000 + static_cast<std::uint64_t>(number));
  for (int subject = 0; subject < shape.subjects; ++subject) {
    const double own = draw();
    int group = 0;
    data.units.push_back("sub-" + std::to_string(subject + 1));
    data.groups.emplace_back();
    for (const auto& [name, groups] : shape.groups) {
      data.groups.back().push_back(groups[static_cast<std::size_t>(subject)]);
      group += data.groups.back().back();
    }
    data.values.emplace_back();
    for (int c = 0; c < cells; ++c) {
      const double u1 = draw(), u2 = draw(), u3 = draw();
      data.values.back().push_back(20 + 6 * own + 0.4 * c * (0.5 + u1) + 3 * (u2 + u3 - 1) * (1 + 0.3 * (c % 3)) +
                                   1.5 * group * (1 + c / 4.0));
    }
  }
  for (const auto& [subject, cell] : shape.missing)
    data.values[static_cast<std::size_t>(subject)][static_cast<std::size_t>(cell)] = none;
  return data;
}

std::array<double, 12> values_of(const AnovaEffect& effect) {
  std::array<double, 12> values{effect.df_effect,
                                effect.df_error,
                                effect.f,
                                effect.p,
                                effect.generalised_eta_squared,
                                effect.partial_eta_squared,
                                none,
                                none,
                                none,
                                none,
                                none,
                                none};
  if (const auto& s = effect.sphericity)
    std::ranges::copy(std::array{s->mauchly_w, s->mauchly_p, s->greenhouse_geisser, s->greenhouse_geisser_p,
                                 s->huynh_feldt, s->huynh_feldt_p},
                      values.begin() + 6);
  return values;
}

TEST(Anova, SaysWhatAfexSaysOfTenDataSets) {
  std::map<std::pair<int, std::string>, AnovaEffect> found;
  const std::vector<Shape> all = shapes();
  for (int number = 1; number <= std::ssize(all); ++number)
    for (const AnovaEffect& effect :
         repeated_measures_anova(data_of(number, all[static_cast<std::size_t>(number - 1)])).effects)
      found[{number, effect.name}] = effect;
  ASSERT_EQ(found.size(), references.size());
  for (const Reference& reference : references) {
    const auto effect = found.find({reference.set, reference.effect});
    ASSERT_NE(effect, found.end()) << reference.set << " " << reference.effect;
    const std::array<double, 12> values = values_of(effect->second);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(reference.values[i]))
        EXPECT_TRUE(std::isnan(values[i])) << reference.set << " " << reference.effect << " " << i;
      else
        EXPECT_NEAR(values[i], reference.values[i], 1e-6 * std::max(1.0, std::abs(reference.values[i])))
            << reference.set << " " << reference.effect << " " << i;
    }
  }
}

TEST(Anova, UnitsWithAMissingCellAreLeftOutAndNamed) {
  const AnovaResult result = repeated_measures_anova(data_of(3, shapes()[2]));
  EXPECT_THAT(result.left_out, ElementsAre("sub-2", "sub-7"));
  EXPECT_EQ(result.units, 6);
}

TEST(Anova, TooFewUnitsHaveNoEffects) {
  AnovaData data = data_of(1, {{3}, 1});
  EXPECT_TRUE(repeated_measures_anova(data).effects.empty());
  data.values[0][1] = none;
  EXPECT_EQ(repeated_measures_anova(data).units, 0);
}

TEST(Anova, WithoutVarianceIsNotAvailable) {
  // Each unit has the same differences between its cells, up to rounding.
  AnovaData data{.factors = {{"a", 3}}};
  for (int unit = 0; unit < 6; ++unit) {
    data.units.push_back("sub-" + std::to_string(unit));
    data.values.push_back({18 + 0.1 * unit, 18.3 + 0.1 * unit, 18.7 + 0.1 * unit});
  }
  const AnovaEffect differs = repeated_measures_anova(data).effects.at(0);
  EXPECT_TRUE(std::isnan(differs.f) && std::isnan(differs.p) && std::isnan(differs.partial_eta_squared));
  EXPECT_FALSE(differs.sphericity);
  for (std::vector<double>& cells : data.values) cells = {18.1, 18.1, 18.1};
  const AnovaEffect equal = repeated_measures_anova(data).effects.at(0);
  EXPECT_TRUE(std::isnan(equal.f) && std::isnan(equal.p) && std::isnan(equal.generalised_eta_squared));
  EXPECT_TRUE(std::isnan(min_f_prime(differs, equal).p));
}

TEST(Anova, DifferencesOfWhichOneHasNoVarianceHaveNoMauchly) {
  AnovaData data{.factors = {{"a", 3}}};
  for (int unit = 0; unit < 6; ++unit) {
    data.units.push_back("sub-" + std::to_string(unit));
    data.values.push_back({18, 18, 18.7 + 0.1 * unit * unit});
  }
  const AnovaEffect effect = repeated_measures_anova(data).effects.at(0);
  EXPECT_GT(effect.f, 0);
  ASSERT_TRUE(effect.sphericity);
  EXPECT_NEAR(effect.sphericity->mauchly_w, 0, 1e-12);
  EXPECT_TRUE(std::isnan(effect.sphericity->mauchly_p));
  EXPECT_NEAR(effect.sphericity->greenhouse_geisser, 0.5, 1e-9);
}

TEST(MinFPrime, IsClarksQuotient) {
  // F1(1, 38) = 9.20 and F2(1, 77) = 10.48 of Hassaine 2010, 3.2.3.
  const MinF result =
      min_f_prime({.df_effect = 1, .df_error = 38, .f = 9.20}, {.df_effect = 1, .df_error = 77, .f = 10.48});
  EXPECT_NEAR(result.f, 9.20 * 10.48 / 19.68, 1e-9);
  EXPECT_NEAR(result.df_error, 19.68 * 19.68 / (9.20 * 9.20 / 77 + 10.48 * 10.48 / 38), 1e-9);
  EXPECT_NEAR(result.p, 0.0294, 1e-3);
}

TEST(PairedT, IsStudents) {
  // R: t.test(c(5, 7, 9, 6), c(4, 7, 6, 4), paired = TRUE)
  const std::vector<double> first{5, 7, 9, 6, none}, second{4, 7, 6, 4, 3};
  const PairedT result = paired_t(first, second);
  EXPECT_NEAR(result.t, 2.32379, 1e-5);
  EXPECT_EQ(result.df, 3);
  EXPECT_NEAR(result.p, 0.1027280789, 1e-9);
  EXPECT_NEAR(result.cohens_dz, 1.161895, 1e-6);
}

TEST(PairedT, OfEqualDifferencesIsNotAvailable) {
  const std::vector<double> first{5.1, 7.1, 9.1}, second{4, 6, 8};
  const PairedT result = paired_t(first, second);
  EXPECT_NEAR(result.mean, 1.1, 1e-12);
  EXPECT_TRUE(std::isnan(result.t) && std::isnan(result.p) && std::isnan(result.cohens_dz));
}

TEST(Holm, LeavesOutWhatIsNotAvailable) {
  const std::vector<double> corrected = holm_corrected({0.01, none, 0.04, none, 0.03});
  EXPECT_NEAR(corrected[0], 0.03, 1e-12);
  EXPECT_NEAR(corrected[4], 0.06, 1e-12);
  EXPECT_TRUE(std::isnan(corrected[1]) && std::isnan(corrected[3]));
}

TEST(Holm, CorrectsSeveralTests) {
  EXPECT_THAT(holm_corrected({0.01, 0.04, 0.03, 0.5}), ElementsAre(testing::DoubleEq(0.04), testing::DoubleEq(0.09),
                                                                   testing::DoubleEq(0.09), testing::DoubleEq(0.5)));
}

TEST(Power, IsThatOfTheNoncentralF) {
  // R: pf(qf(.95, 1, 38), 1, 38, ncp = 9.2, lower.tail = FALSE)
  EXPECT_NEAR(power_of_f(1, 38, 9.2), 0.8403053221, 1e-6);
  EXPECT_NEAR(power_of_f(4, 56, 0), 0.05, 1e-9);
}

}  // namespace wheatstone::anova_test
