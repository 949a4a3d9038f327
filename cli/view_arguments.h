#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options.h"

namespace wheatstone::cli {

/// What the window is to begin with, as it is typed.
struct ViewArguments {
  Given given;
  std::vector<std::string> files;
  std::string mode, style, display, camera, quantity, focus, script, control, bridge_calibration;
  std::string size = "960x640";
  std::optional<float> focus_radius, focus_gain;
  int threads = 0;         ///< as of every command; 0: as many as the machine has
  std::uint64_t seed = 1;  ///< likewise
  bool commands = false, full_screen = false, opengl = false, no_opengl = false, stereo = false;
};

/// The files and options of `wheatstone view`, which the window's own program takes as well.
Rows view_rows(ViewArguments& arguments);

}  // namespace wheatstone::cli
