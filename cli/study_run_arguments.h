#pragma once

#include <string>

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

}  // namespace wheatstone::cli
