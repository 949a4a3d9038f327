#include "wheatstone/study/published.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "throws_error.h"
#include "wheatstone/study/analysis_report.h"
#include "wheatstone/study/simulate.h"

namespace wheatstone::published_test {

TEST(Published, MeansShipWithTheDesignsOfPublishedStudies) {
  for (const auto& [name, means] :
       {std::pair("path-searching-1", 26), {"path-searching-2", 10}, {"painting-comfort", 3}, {"two-or-forty-five", 0}})
    EXPECT_EQ(std::ssize(load_study_design(name).published), means) << name;
}

TEST(Published, ThesisMeansGiveItsAverages) {
  const StudyDesign design = load_study_design("path-searching-1");
  double sum = 0;
  int count = 0;
  for (const PublishedMean& mean : design.published)
    if (mean.measure == "percent_correct") {
      sum += mean.mean;
      ++count;
    }
  EXPECT_EQ(count, 13);
  EXPECT_NEAR(sum / count, 90, 0.6);  // "average percent of correct responses was 90%"
}

TEST(Published, OrderOfASimulatedComfortStudyIsThePapers) {
  const StudyDesign design = load_study_design("painting-comfort");
  SimulatedObservers observers{.rating = 3.5, .lapses = 0};
  observers.effects = {
      {"version", "original", 0, 1.05}, {"version", "consistent", 0, 0.2}, {"version", "inconsistent", 0, -1.4}};
  const StudyData data = simulate_study(design, observers, 30, 1);
  const std::vector<PublishedComparison> found = beside_published(design, analyse_study(data));
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].measure, "rating");
  EXPECT_NEAR(found[0].order, 1, 1e-12);
  for (const BesidePublished& one : found[0].conditions) EXPECT_LT(std::abs(one.off), 0.6) << one.condition;
  std::swap(observers.effects[0].share, observers.effects[2].share);
  const StudyData reversed = simulate_study(design, observers, 30, 1);
  EXPECT_NEAR(beside_published(design, analyse_study(reversed))[0].order, -1, 1e-12);
}

TEST(Published, TableIsWrittenWhereItIsAskedFor) {
  const StudyDesign design = load_study_design("path-searching-2");
  const StudyData data = simulate_study(design, {}, 5, 1);
  const StudyAnalysis analysis = analyse_study(data);
  EXPECT_EQ(analysis_tables(data, analysis).size(), 5);
  const auto tables = analysis_tables(data, analysis, beside_published(design, analysis));
  ASSERT_EQ(tables.size(), 6);
  EXPECT_THAT(tables.back().second, testing::HasSubstr("views_per_10cm=8\t"));
  EXPECT_EQ(std::ranges::count(tables.back().second, '\n'), 11);
}

TEST(Published, WhatIsNotThereOrWrongIsNamed) {
  const StudyDesign design = load_study_design("two-or-forty-five");
  const StudyAnalysis analysis = analyse_study(simulate_study(design, {}, 4, 1));
  expect_error(ErrorKind::bad_input, "has no published means", [&] { beside_published(design, analysis); });
  const std::string toml = load_study_design("painting-comfort").toml;
  const auto refused = [&](std::string_view from, std::string_view to, const std::string& part) {
    std::string changed = toml;
    changed.replace(changed.find(from), from.size(), to);
    expect_error(ErrorKind::bad_input, part, [&] { parse_study_design(changed, "mine.toml"); });
  };
  refused("[published.rating]", "[published.comfort]", "unknown key 'comfort'");
  refused("[4.55, 0.66]", "[4.55]", "expected [mean, standard deviation]");
  refused("[4.55, 0.66]", "[4.55, -1]", "expected [mean, standard deviation]");
  refused("[4.55, 0.66]", "4.55", "expected [mean, standard deviation]");
  refused("\"version=original\"", "\"version=other\"", "a condition of the design");
}

}  // namespace wheatstone::published_test
