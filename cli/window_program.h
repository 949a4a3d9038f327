#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "options.h"

namespace wheatstone::cli {

/// How a session is to be run, as it is typed.
struct StudyRunArguments {
  Given given;
  std::string design;
  std::string folder = "study";
  int subject = 1;
  std::string mode = "red-cyan";
  double screen_width_mm = 0;  ///< 0: as the screen tells
  double card_px = 0;          ///< width of a bank card held to the screen; 0: not measured
  double distance_mm = 700;
  double eye_separation_mm = 65;
  int tracker_port = -1;  ///< none
  bool pointer = false, opengl = false, no_opengl = false;
  std::string size;  ///< of a window instead of the full screen
};

/// The options of `wheatstone study run`, which the window's own program takes as well.
Rows study_run_rows(StudyRunArguments& arguments);

/// Width of a screen of so many pixels, in mm, where it was given or measured by a card; 0 where neither.
double screen_width_mm(const StudyRunArguments& arguments, int width_px);

/// What the window is to begin with, as it is typed.
struct ViewArguments {
  Given given;
  std::vector<std::string> files;
  std::string mode, style, display, camera, quantity, where, focus, script, control, bridge_calibration;
  std::string size = "960x640";
  std::optional<float> focus_radius, focus_gain;
  int threads = 0;         ///< as of every command; 0: as many as the machine has
  std::uint64_t seed = 1;  ///< likewise
  bool commands = false, full_screen = false, opengl = false, no_opengl = false, stereo = false;
};

/// The files and options of `wheatstone view`, which the window's own program takes as well.
Rows view_rows(ViewArguments& arguments);

/// Starts the window's program with these words, which needs a window system that this one does without, and waits for
/// it. The report has its exit code; throws Error where it cannot be started or was interrupted.
Report run_window_program(std::vector<std::string> words, const Session& session);

}  // namespace wheatstone::cli
