#include "study_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer::study_runner_test {

using testing::HasSubstr;

constexpr StudyScreen small{.width_px = 80, .height_px = 60};

/// Four trials after one for practice, a pause after each second, one question.
StudyDesign small_design() {
  return parse_study_design(
      "name = 'small'\ntask_label = 'paths'\nsubjects = 4\nrepetitions = 2\npractice = 1\nbreak_every = 2\n"
      "[shown]\nnodes = 30\n[texts]\ninstruction = 'Look.'\nquestion = 'Path?'\nyes = 'ja'\nno = 'nein'\npause = "
      "'Rest.'\nthanks = 'Thank you.'\n"
      "[[factor]]\nname = 'views_per_10cm'\nlevels = [0, 8]\n"
      "[[question]]\nname = 'tired'\ntext = 'Tired?'\nleast_means = 'no'\nmost_means = 'yes'\n",
      "small.toml");
}

class StudySession : public testing::Test {
 protected:
  /// Begins the session again, as after the machine died.
  void begin() {
    end();
    runner_ = std::make_unique<StudyRunner>(study_, 1, small);
  }
  void end() { runner_.reset(); }
  StudyRunner& runner() { return *runner_; }
  /// A page is seen, and a key pressed two seconds later.
  bool press(const std::string& name) {
    runner_->shown(now_s_);
    now_s_ += 2;
    return runner_->key(name, now_s_, now_s_ + 0.003);
  }
  void press_all(std::initializer_list<const char*> names) {
    for (const char* name : names) EXPECT_TRUE(press(name)) << name;
  }
  const StudyFolder& study() const { return study_; }

  double now_s_ = 100;

 private:
  TemporaryFolder folder_;
  StudyFolder study_{folder_ / "data", small_design(), false};
  std::unique_ptr<StudyRunner> runner_;
};

TEST_F(StudySession, GoesFromTheInstructionToTheLastQuestion) {
  begin();
  EXPECT_EQ(runner().text(), "Look.\n\nPath?\nY: ja      N: nein");
  press_all({"space"});
  EXPECT_TRUE(runner().shows_stimulus());
  EXPECT_EQ(runner().progress(), "sub-02: practice");
  press_all({"y"});
  EXPECT_THAT(runner().text(), HasSubstr("practice is over"));
  press_all({"space", "n", "y"});
  EXPECT_EQ(runner().text(), "Rest.");
  EXPECT_EQ(runner().progress(), "sub-02: 2 of 4 trials done");
  press_all({"space", "y", "n"});
  EXPECT_EQ(runner().text(), "Tired?\n\n1 (no) … 5 (yes)");
  EXPECT_FALSE(press("6")) << "is not on the scale";
  press_all({"4"});
  EXPECT_EQ(runner().text(), "Thank you.");
  press_all({"space"});
  EXPECT_TRUE(runner().is_finished());
  const StudyData data = read_study(study().path());
  ASSERT_EQ(data.subjects.size(), 1u);
  EXPECT_EQ(data.subjects[0].trials.size(), 4u);
  EXPECT_EQ(data.subjects[0].answers.at(0).second, 4);
  EXPECT_FALSE(data.simulated);
}

TEST_F(StudySession, TimesAreFromTheShownFrameToTheKey) {
  begin();
  press_all({"space", "y", "space"});
  runner().shown(200);
  runner().shown(200.5);
  EXPECT_FALSE(runner().key("y", 199.9, 200.1)) << "was pressed before the stimulus was seen";
  EXPECT_FALSE(runner().key("x", 201, 201)) << "is no answer";
  EXPECT_TRUE(runner().key("y", 203.25, 203.262));
  const TrialRecord record = read_subject(study(), 1).trials.at(0);
  EXPECT_DOUBLE_EQ(record.response_time_s, 3.25);
  EXPECT_NEAR(record.log_delay_s, 0.012, 1e-6);
  EXPECT_EQ(record.response, 1);
}

TEST_F(StudySession, TheHeadsPathIsRecorded) {
  begin();
  press_all({"space", "y", "space"});
  runner().head_at({500, 700}, 199);
  runner().head_at({10, 700}, 199.5);
  runner().shown(200);
  runner().head_at({-80, 700}, 200.5);
  runner().head_at({40, 700}, 201);
  EXPECT_TRUE(runner().key("n", 203, 203));
  const TrialRecord record = read_subject(study(), 1).trials.at(0);
  EXPECT_DOUBLE_EQ(record.head_least_m, -0.08) << "what was before the stimulus does not count";
  EXPECT_DOUBLE_EQ(record.head_most_m, 0.04);
  EXPECT_THAT(bytes_of(study().head_path(1)), HasSubstr("1\t0.500000\t-0.0800\t0.7000\tperson\n1\t1.000000\t0.0400"));
}

TEST_F(StudySession, GoesOnWhereItStopped) {
  begin();
  press_all({"space", "y", "space", "n"});
  begin();
  EXPECT_EQ(runner().progress(), "sub-02: 1 of 4 trials done") << "without practice";
  EXPECT_EQ(runner().beginning(), "sub-02: goes on with trial 2 of 4");
  press_all({"space", "y", "space", "y", "n"});
  begin();
  EXPECT_EQ(runner().beginning(), "sub-02: goes on with question 1 of 1");
  press_all({"space", "4", "space"});
  std::set<int> items;
  for (const TrialRecord& record : read_subject(study(), 1).trials) items.insert(record.item);
  EXPECT_EQ(items.size(), 4u) << "each trial once";
  begin();
  EXPECT_TRUE(runner().is_finished());
}

TEST_F(StudySession, ASubjectIsTestedByOneSessionAtATime) {
  begin();
  press_all({"space", "y", "space", "n"});
  const std::string table = bytes_of(study().trial_table(1));
  expect_error(ErrorKind::wrong_usage, "sub-02_task-paths_beh.tsv: another session writes it",
               [&] { StudyRunner(study(), 1, small); });
  EXPECT_EQ(bytes_of(study().trial_table(1)), table);
  EXPECT_NO_THROW(StudyRunner(study(), 2, small)) << "another subject";
  press_all({"y"});
  EXPECT_EQ(bytes_of(study().trial_table(1)).substr(0, table.size()), table) << "answers are appended";
}

TEST_F(StudySession, GoesOnOnlyWithTheTrialsThatTheSubjectMet) {
  begin();
  press_all({"space", "y", "space", "n", "y"});
  end();
  const std::string table = bytes_of(study().trial_table(1));
  const std::size_t second = table.find('\n') + 1, third = table.find('\n', second) + 1;
  put_bytes(study().trial_table(1), table.substr(0, second) + table.substr(third));
  expect_error(ErrorKind::bad_input, "_beh.tsv:2: is not the subject's trial 1", [&] { begin(); });
  put_bytes(study().trial_table(1), "notes of mine\nand more");
  expect_error(ErrorKind::bad_input, "_beh.tsv:1: has other columns", [&] { begin(); });
  EXPECT_EQ(bytes_of(study().trial_table(1)), "notes of mine\nand more") << "is left as it is";
}

TEST_F(StudySession, DrawsAgainWhereTheHeadComesToAnotherView) {
  begin();
  press_all({"space", "y", "space"});
  int fixed = 0, moving = 0;
  for (int trial = 0; trial < 2; ++trial) {
    EXPECT_TRUE(runner().views_changed()) << "the first frame";
    const StereoPair middle = runner().draw();
    runner().head_at({3, 700}, 0);
    EXPECT_FALSE(runner().views_changed()) << "still the nearest view";
    runner().head_at({60, 700}, 0);
    const bool changed = runner().views_changed();
    EXPECT_EQ(changed, runner().draw().left != middle.left);
    ++(changed ? moving : fixed);
    runner().head_at({0, 700}, 0);
    press("y");
  }
  EXPECT_EQ(fixed, 1) << "the condition of no views along the movement";
  EXPECT_EQ(moving, 1);
}

/// One painting as the stimulus of every trial, on a display of 8 views per 10 cm.
StudyDesign painting_design() {
  return parse_study_design(
      "name = 'painted'\ntask_label = 'comfort'\ntask = 'rating'\nsubjects = 2\nrepetitions = 1\n"
      "[shown]\nviews_per_10cm = 8\n[pictures]\nitems = ['fruit', 'bowl']\nleft = '{item}.wst'\n"
      "[[factor]]\nname = 'monoscopic'\nlevels = [false, true]\n",
      "painted.toml");
}

TEST(StudySessionOfPaintings, EachEyeSeesItsViewAndTheHeadMovesBoth) {
  const TemporaryFolder folder;
  const StudyFolder study(folder / "data", painting_design(), false);
  std::filesystem::create_directories(study.stimuli());
  StrokePainting strokes{.width = 80, .height = 60};
  // The nearer dot lies on the screen; the farther one moves.
  const Stroke far{.point_count = 1, .radius_px = 8, .colour = {200, 20, 20}, .disparity = 2, .views = all_views};
  const Stroke near{
      .first_point = 1, .point_count = 1, .radius_px = 8, .colour = {20, 20, 200}, .disparity = 9, .views = all_views};
  strokes.layers.push_back({8, {{20, 30, 2}, {60, 30, 9}}, {far, near}});
  write_painting(study.stimuli() / "fruit.wst", Painting{strokes});
  write_painting(study.stimuli() / "bowl.wst", Painting{strokes});
  StudyRunner runner(study, 0, small);
  runner.shown(0);
  runner.key("space", 1, 1);
  ASSERT_TRUE(runner.shows_stimulus());
  EXPECT_TRUE(runner.views_changed()) << "the first frame";
  const StereoPair middle = runner.draw();
  runner.head_at({60, 700}, 2);
  EXPECT_TRUE(runner.views_changed());
  EXPECT_NE(runner.draw().left, middle.left);
  runner.head_at({0, 700}, 3);
  const bool first_differs = middle.left != middle.right;
  runner.shown(4);
  runner.key("3", 5, 5);
  const StereoPair other = runner.draw();
  EXPECT_NE(first_differs, other.left != other.right) << "one of the conditions is monoscopic";
}

TEST_F(StudySession, AStimulusThatIsDamagedOrAnothersIsRefusedBeforeTheSession) {
  begin();
  end();
  const std::vector<PlannedTrial> trials = plan_trials(study().design(), 1);
  const auto file_of = [&](const PlannedTrial& trial) {
    const StudyCondition condition =
        conditions_of_group(study().design(), 0)[static_cast<std::size_t>(trial.condition)];
    return study().stimuli() / stimulus_files(study().design(), trial.item, condition).front();
  };
  const std::filesystem::path last = file_of(trials.back());
  const bool answer = is_connected(study().design(), trials.back().item);
  const auto other = std::ranges::find_if(
      trials, [&](const PlannedTrial& trial) { return is_connected(study().design(), trial.item) != answer; });
  ASSERT_NE(other, trials.end());
  const std::string whole = bytes_of(last);
  put_bytes(last, bytes_of(file_of(*other)));
  expect_error(ErrorKind::bad_input, last.string() + ": connected: is " + (answer ? "false" : "true"),
               [&] { begin(); });
  put_bytes(last, whole.substr(0, whole.size() / 2));
  expect_error(ErrorKind::bad_input, last.string() + ": is no path graph", [&] { begin(); });
  put_bytes(last, whole);
  EXPECT_NO_THROW(begin());
}

TEST(StudySessionOfPictures, EyesOfDifferentSizesAreRefused) {
  const TemporaryFolder folder;
  const StudyDesign design = parse_study_design(
      "name = 'pairs'\ntask_label = 'comfort'\ntask = 'rating'\nsubjects = 2\nrepetitions = 1\n"
      "[pictures]\nitems = ['a', 'b']\nleft = '{item}_left.png'\nright = '{item}_right.png'\n"
      "[[factor]]\nname = 'views_per_10cm'\nlevels = [0, 8]\n",
      "pairs.toml");
  const StudyFolder study(folder / "data", design, false);
  std::filesystem::create_directories(study.stimuli());
  for (const char* name : {"a_left.png", "a_right.png", "b_left.png", "b_right.png"})
    write_image(study.stimuli() / name, Image<Rgb8>(40, std::string_view(name).ends_with("left.png") ? 30 : 20));
  StudyRunner runner(study, 0, small);
  runner.shown(0);
  runner.key("space", 1, 1);
  expect_error(ErrorKind::bad_input, "_right.png: the picture is 40x20 pixels, expected the left eye's 40x30",
               [&] { runner.draw(); });
}

TEST_F(StudySession, TheHeadsDistanceChangesTheViews) {
  begin();
  press_all({"space", "y", "space"});
  int changed = 0;
  for (int trial = 0; trial < 2; ++trial) {
    runner().views_changed();
    runner().head_at({0, 600}, 0);
    changed += runner().views_changed() ? 1 : 0;
    runner().head_at({0, 700}, 0);
    press("y");
  }
  EXPECT_EQ(changed, 1) << "where views follow the head at all";
}

TEST_F(StudySession, ASubjectThatTheDesignDoesNotHaveIsRefused) {
  expect_error(ErrorKind::bad_input, "subject: is 5, expected a number from 1 to 4",
               [&] { StudyRunner(study(), 4, small); });
}

}  // namespace wheatstone::viewer::study_runner_test
