#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/study/path_graph.h"
#include "wheatstone/study/simulated_display.h"
#include "wheatstone/study/study_folder.h"
#include "wheatstone/study/trial_plan.h"

namespace wheatstone::viewer {

/// A stimulus of a study that can be looked at from anywhere: a painting (.wst), whose nearest marks lie on the screen,
/// or slices of particles (.exr).
class StudyScene {
 public:
  /// Whether a file's name says that it is one.
  static bool is_named(const std::filesystem::path& path);
  /// Throws Error{bad_input}.
  explicit StudyScene(const std::filesystem::path& path);

  Image<Rgb8> draw(ViewPosition view) const;

 private:
  std::variant<PreparedPainting, SliceStack> scene_;
};

/// A subject's session, from the instruction to the last question: what is on the screen, and what keys and the head
/// do. Knows no window system. Times are of one clock that never goes back, in s. A session that was broken off goes on
/// with its first trial without an answer.
class StudyRunner {
 public:
  /// Holds the subject's table as long as it lives. Throws Error as StudyFolder and TrialLog do, and Error{bad_input}
  /// where a stimulus is missing, the subject has no row in the design, or its answers are not those of the trials that
  /// it was to meet.
  StudyRunner(const StudyFolder& folder, int subject, const StudyScreen& screen);

  /// What subjects read now; empty while a stimulus is shown.
  std::string text() const;
  bool shows_stimulus() const { return page_ == Page::trial; }
  bool is_finished() const { return page_ == Page::end; }
  /// For the experimenter, when the session begins: where it goes on, "sub-01: goes on with trial 13 of 78".
  std::string beginning() const;
  /// For the experimenter: "sub-01: 12 of 78 trials done", without answers.
  std::string progress() const;

  /// Both eyes' pictures of the stimulus, for the head's place. Throws Error{bad_input}.
  StereoPair draw();
  /// Whether the eyes see other views than when this was last asked.
  bool views_changed();

  /// The screen has shown the page's first frame.
  void shown(double time_s);
  /// A key that was pressed at one time and came to the program at another: "space", or a letter or digit. True where
  /// it changed what is shown. Throws Error{cannot_read_write} where the answer cannot be written; see TrialLog.
  bool key(const std::string& name, double pressed_s, double noted_s);
  /// The head is here.
  void head_at(const HeadPlace& head, double time_s);

 private:
  enum class Page { instruction, trial, practice_ends, pause, question, thanks, end };

  const PlannedTrial& planned() const { return trials_[next_]; }
  const StudyCondition& condition() const { return conditions_[static_cast<std::size_t>(planned().condition)]; }
  /// The files of a trial's stimulus.
  std::vector<std::filesystem::path> stimulus(const PlannedTrial& trial) const;
  /// Throws Error{bad_input} where the file is no graph, or the answer is not the design's.
  PathGraph graph_of(const PlannedTrial& trial) const;
  void check_answered() const;
  const StudyScene& scene(const std::filesystem::path& path);
  bool answer_trial(const std::string& name, double pressed_s, double noted_s);
  bool answer_question(const std::string& name);
  void record(int response, double pressed_s, double noted_s);
  void go_to_trial_or_on();
  void go_to_question_or_end();
  void begin_trial();
  /// How many trials that count lie before the next one.
  int counted() const;

  const StudyFolder& folder_;
  StudyScreen screen_;
  std::vector<StudyCondition> conditions_;
  std::vector<PlannedTrial> trials_;
  std::size_t next_ = 0;
  SubjectRecords records_;
  std::unique_ptr<TrialLog> log_, head_log_;
  Page page_ = Page::instruction;
  std::size_t question_ = 0;
  std::optional<double> shown_s_;
  HeadPlace head_;
  TrialRecord now_;        ///< of the trial that is shown
  std::string head_path_;  ///< its lines
  std::array<SimulatedView, 2> seen_{};
  std::filesystem::path scene_path_;
  std::optional<StudyScene> scene_;  ///< that was last shown
};

}  // namespace wheatstone::viewer
