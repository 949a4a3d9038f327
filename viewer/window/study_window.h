#pragma once

#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include "picture_surface.h"
#include "viewer/head_tracker.h"
#include "viewer/output_mode.h"
#include "viewer/study_runner.h"

class QLabel;

namespace wheatstone::viewer {

struct StudyWindowOptions {
  const OutputMode* mode = nullptr;  ///< in which each eye's picture fills the screen
  OpenglUse opengl = OpenglUse::where_fast;
  bool head_by_pointer = false;     ///< the pointer's place stands for the head's
  double pointer_range_mm = 400;    ///< across the screen
  float viewing_distance_mm = 700;  ///< at which the tracker was centred
};

/// A session on a screen: shows what a StudyRunner says, and brings it keys, the moments of frames and the head. What
/// the experimenter may know goes to standard output.
class StudyWindow final : public QWidget {
 public:
  StudyWindow(StudyRunner& runner, const StudyWindowOptions& options);
  ~StudyWindow() override;

  /// From now on the head is where this tracker says.
  void track(std::unique_ptr<HeadTracker> tracker) { tracker_ = std::move(tracker); }
  /// Shows the first page. Before, the window is to have its size.
  void begin();
  /// How the program ends: 0, or an error's kind, which is told on standard error.
  int exit_code() const { return exit_code_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void show_page();
  void show_stimulus();
  void follow_head();
  void frame_is_shown();
  void tell(const std::string& line);
  void end(int exit_code);
  /// Does what may throw; the session then ends and says why.
  template <class Action>
  void guarded(Action action);

  StudyRunner& runner_;
  StudyWindowOptions options_;
  std::unique_ptr<PictureSurface> surface_;
  QLabel* page_;
  std::unique_ptr<HeadTracker> tracker_;
  QTimer following_;
  HeadPlace head_;
  bool waits_for_frame_ = false;
  int exit_code_ = 0;
};

/// The part of the program that runs a subject's session. `argv` begins with the word "study". Returns the
/// exit code. Throws Error.
int run_study(int argc, char** argv);

}  // namespace wheatstone::viewer
