#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wheatstone::cli {

/// What the window is to begin with, as it is typed.
struct ViewArguments {
  std::vector<std::string> files;
  std::string mode, style, display, camera, quantity, focus, script, control, bridge_calibration;
  std::string size = "960x640";
  std::optional<float> focus_radius, focus_gain;
  int threads = 0;         ///< as of every command; 0: as many as the machine has
  std::uint64_t seed = 1;  ///< likewise
  bool commands = false, full_screen = false, opengl = false, no_opengl = false, stereo = false;
};

/// Adds the files and options of `wheatstone view`, which the window's own program takes as well.
void add_view_options(CLI::App& command, ViewArguments& arguments);

/// What the command was given of these, as the words of another line.
std::vector<std::string> view_words(const CLI::App& command);

}  // namespace wheatstone::cli
