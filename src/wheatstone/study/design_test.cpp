#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "throws_error.h"
#include "wheatstone/study/latin_square_internal.h"
#include "wheatstone/study/study_design.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::design_test {

/// Two factors within and one condition beside them, of few trials.
std::string small_design(const std::string& more) {
  return "name = 'small'\ntask_label = 'paths'\nrepetitions = 2\npractice = 1\n" + more +
         "\n[[factor]]\nname = 'depth_cm'\nlevels = [2, 10]\n"
         "[[factor]]\nname = 'views_per_10cm'\nlevels = [0, 8]\n";
}

void expect_refused_design(const std::string& toml, const std::string& part) {
  expect_error(ErrorKind::bad_input, part, [&] { parse_study_design(toml, "mine.toml"); });
}

TEST(OrderSquare, WilliamsHasEachConditionBehindEachOtherEquallyOften) {
  for (const int n : {2, 4, 5, 6, 13}) {
    const OrderSquare square = williams_square(n);
    EXPECT_EQ(square.size(), static_cast<std::size_t>(n % 2 == 0 ? n : 2 * n)) << "26 rows for 13, 10 for 5";
    std::map<std::pair<int, int>, int> follows, at_place;
    for (const std::vector<int>& row : square)
      for (int place = 0; place < n; ++place) {
        ++at_place[{row[static_cast<std::size_t>(place)], place}];
        if (place > 0) ++follows[{row[static_cast<std::size_t>(place - 1)], row[static_cast<std::size_t>(place)]}];
      }
    const int times = n % 2 == 0 ? 1 : 2;
    EXPECT_EQ(follows.size(), static_cast<std::size_t>(n * (n - 1)));
    for (const auto& [pair, count] : follows) EXPECT_EQ(count, times);
    for (const auto& [pair, count] : at_place) EXPECT_EQ(count, times);
  }
}

TEST(BuiltInDesigns, AreBalanced) {
  for (const BuiltInDesign& built_in : built_in_designs()) {
    const StudyDesign design = parse_study_design(built_in.toml, built_in.name);
    EXPECT_EQ(design.name, built_in.name);
    const DesignBalance balance = count_balance(design);
    EXPECT_TRUE(balance.positions) << built_in.name;
    EXPECT_TRUE(balance.items) << built_in.name;
    EXPECT_EQ(balance.follows, order_text(design).starts_with("Williams")) << built_in.name;
  }
}

int counted_trials(const StudyDesign& design, int subject) {
  const std::vector<PlannedTrial> trials = plan_trials(design, subject);
  return static_cast<int>(std::ranges::count(trials, false, &PlannedTrial::practice));
}

TEST(BuiltInDesigns, HaveTheThesisNumbers) {
  const StudyDesign first = load_study_design("path-searching-1"), second = load_study_design("path-searching-2");
  EXPECT_EQ(conditions_of_group(first, 0).size(), 13u);
  EXPECT_EQ(counted_trials(first, 0), 78);
  EXPECT_EQ(counted_trials(second, 14), 100);
  EXPECT_EQ(order_text(first), "Latin squares of 13 rows") << "39 subjects";
  EXPECT_EQ(order_text(second), "Latin squares of 5 rows") << "15 subjects";
  const auto freedom = [](const StudyDesign& design, std::size_t effect) {
    const DesignEffect found = degrees_of_freedom(design)[effect];
    return std::array<int, 3>{found.effect, found.error_subjects, found.error_items};
  };
  EXPECT_EQ(freedom(second, 0), (std::array<int, 3>{4, 56, 396}));
  EXPECT_EQ(degrees_of_freedom(first)[0].name, "depth_cm");
  EXPECT_EQ(freedom(first, 0), (std::array<int, 3>{1, 38, 77}));
  EXPECT_EQ(degrees_of_freedom(first)[1].name, "depth_cm:views_per_10cm");
  EXPECT_EQ(freedom(first, 1), (std::array<int, 3>{5, 190, 385}));
  EXPECT_EQ(freedom(first, 2), (std::array<int, 3>{5, 190, 385}));
}

TEST(BuiltInDesigns, WilliamsSquaresAreTakenWhereTheSubjectsAllow) {
  std::string toml(built_in_designs()[0].toml);
  toml.replace(toml.find("subjects = 39"), 13, "subjects = 26");
  const StudyDesign design = parse_study_design(toml, "mine.toml");
  EXPECT_EQ(order_text(design), "Williams squares of 26 rows");
  EXPECT_TRUE(count_balance(design).follows);
}

TEST(TrialPlan, EachSubjectMeetsEachItemOnceAndHalfOfThemAreYes) {
  const StudyDesign design = load_study_design("path-searching-1");
  for (const int subject : {0, 7, 38}) {
    std::set<int> items;
    std::map<int, int> yes;
    for (const PlannedTrial& trial : plan_trials(design, subject)) {
      if (trial.practice) continue;
      items.insert(trial.item);
      yes[trial.condition] += is_connected(design, trial.item) ? 1 : 0;
    }
    EXPECT_EQ(items.size(), 78u);
    for (const auto& [condition, count] : yes) EXPECT_EQ(count, 3) << condition;
  }
}

TEST(TrialPlan, AnItemIsMetAtDifferentTimes) {
  const StudyDesign design = load_study_design("path-searching-1");
  std::set<int> places;
  for (int subject = 0; subject < design.subjects; ++subject)
    for (const PlannedTrial& trial : plan_trials(design, subject))
      if (!trial.practice && trial.item == 5) places.insert(trial.place);
  EXPECT_GT(places.size(), 6u) << "items are not tied to places by the square";
}

TEST(StudyDesign, ConditionsSetWhatIsShown) {
  const std::vector<StudyCondition> conditions = conditions_of_group(load_study_design("path-searching-1"), 0);
  EXPECT_EQ(conditions[8].name, "depth_cm=10,views_per_10cm=4");
  EXPECT_EQ(conditions[8].shown.depth_mm, 100);
  EXPECT_EQ(conditions[8].shown.display.views_per_10cm, 4);
  EXPECT_TRUE(conditions[12].is_control);
  EXPECT_EQ(conditions[12].shown.depth_mm, 0);
  EXPECT_TRUE(conditions_of_group(load_study_design("path-searching-2"), 0)[0].shown.display.monoscopic);
}

TEST(StudyDesign, SubjectsAreSharedByGroups) {
  const StudyDesign design = parse_study_design(
      small_design("subjects = 8\n[[factor]]\nname = 'nodes'\nbetween = true\nlevels = [60, 90]"), "mine.toml");
  EXPECT_EQ(group_count(design), 2);
  EXPECT_EQ(conditions_of_group(design, 1)[0].shown.nodes, 90);
  EXPECT_EQ(conditions_of_group(design, 1).size(), 4u);
  EXPECT_TRUE(count_balance(design).items);
}

TEST(StudyDesign, ThatCannotBeBalancedIsRefusedWithTheNearestThatCan) {
  expect_refused_design(small_design("subjects = 10"), "10 subjects cannot be balanced over 4 conditions; 8 or 12 can");
  expect_refused_design(small_design("subjects = 3"), "3 subjects cannot be balanced over 4 conditions; 4 can");
  expect_refused_design(small_design("subjects = 9\n[[factor]]\nname = 'nodes'\nbetween = true\nlevels = [60, 90]"),
                        "9 subjects cannot be shared equally by 2 groups; 8 or 10 can");
  std::string thirteen(built_in_designs()[0].toml);
  thirteen.replace(thirteen.find("order = \"balanced\""), 18, "order = \"williams\"");
  expect_refused_design(thirteen,
                        "39 subjects cannot be balanced over 13 conditions by Williams squares; 26 or 52 can");
  expect_refused_design(small_design("subjects = 8\nitems = 12"),
                        "12 items cannot be met equally often in 4 conditions");
  EXPECT_NO_THROW(parse_study_design(small_design("subjects = 10\norder = 'random'"), "mine.toml"));
}

TEST(StudyDesign, WhatIsWrongInAFileIsNamed) {
  expect_refused_design("name = ", "mine.toml:1: is no TOML");
  expect_refused_design(small_design("subjects = 8\nsubject = 8"), "unknown key 'subject'");
  expect_refused_design(small_design(""), "subjects: expected their number");
  expect_refused_design(small_design("subjects = 'many'"), "subjects: expected a whole number from 1 to 10000");
  expect_refused_design(small_design("subjects = 8\norder = 'any'"), "order: expected 'balanced' or 'williams'");
  expect_refused_design(small_design("subjects = 8\n[shown]\ndensity = 3"), "'density' is no setting");
  expect_refused_design(small_design("subjects = 8\n[shown]\ncrosstalk = 3"),
                        "crosstalk is '3', expected a share from 0 to 0.5");
  expect_refused_design(small_design("subjects = 8\nitems = 3"), "8 trials need as many items");
  expect_refused_design(small_design("subjects = 8\n[[factor]]\nname = 'a b'\nlevels = [1, 2]"),
                        "name: expected letters");
  expect_refused_design(small_design("subjects = 8\n[[factor]]\nname = 'a'\nlevels = [1, 1]"), "'1' once only");
  expect_error(ErrorKind::wrong_usage, "is no design, expected path-searching-1", [] { load_study_design("paths"); });
  expect_error(ErrorKind::bad_input, "nowhere.toml", [] { load_study_design("nowhere.toml"); });
}

TEST(StudyDesign, NamesThatCannotBeToldApartAreRefused) {
  const std::string eight = "subjects = 8\n", question = "[[question]]\nname = 'tired'\n";
  expect_refused_design(small_design(eight + question + question), "[[question]]: name: expected 'tired' once only");
  expect_refused_design(small_design(eight + "[[question]]\nname = 'participant_id'\n"),
                        "'participant_id' is a column");
  expect_refused_design(small_design(eight + "[[question]]\nname = 'observer'\n"), "'observer' is a column");
  expect_refused_design(small_design(eight + "[[factor]]\nname = 'response'\nlevels = [1, 2]"),
                        "'response' is a column");
  const std::string flat = "[[control]]\nname = 'flat'\ndepth_cm = 0\n";
  expect_refused_design(small_design("subjects = 6\n" + flat + flat), "[[control]]: name: expected 'flat' once only");
  const std::string pictures =
      "name = 'p'\ntask_label = 'p'\ntask = 'rating'\nsubjects = 2\nrepetitions = 1\n[[factor]]\nname = 'v'\n"
      "levels = [1, 2]\n[pictures]\nleft = '{item}_{v}.png'\n";
  expect_refused_design(pictures + "items = ['a', 'a']", "items: expected 'a' once only");
  expect_refused_design(pictures + R"(items = ['a', "b\tc"])", "items: expected names without control characters");
  expect_refused_design(pictures + "items = ['a', ['b']]", "items: expected names");
}

TEST(StudyDesign, ThatIsTooLargeIsRefused) {
  std::string many = "subjects = 8\n";
  for (int factor = 0; factor < 40; ++factor)
    many += "[[factor]]\nname = 'f" + std::to_string(factor) + "'\nlevels = [1, 2, 3]\n";
  expect_refused_design(small_design(many), "conditions, expected at most 1000");
  expect_refused_design(small_design("subjects = 8\n[shown]\nnodes = 31"),
                        "nodes is '31', expected a multiple of three");
  expect_refused_design(small_design("subjects = 8\n[shown]\nnodes = 30.5"), "nodes is '30.5'");
}

TEST(StudyDesign, PicturesAreNamedByItemAndLevel) {
  const StudyDesign design = load_study_design("painting-comfort");
  const std::vector<StudyCondition> conditions = conditions_of_group(design, 0);
  EXPECT_EQ(stimulus_files(design, 4, conditions[1]),
            (std::vector<std::string>{"05_consistent_left.png", "05_consistent_right.png"}));
}

}  // namespace wheatstone::design_test
