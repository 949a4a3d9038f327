#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "command.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::cli {

/// Photographs as they are typed: two files, or one that holds both views.
struct StereoArguments {
  std::string left, right;  ///< right is empty where left holds both
  std::string layout;       ///< of one picture that holds both; empty: find it
  bool swap = false;
};

/// Adds --layout and --swap.
void add_stereo_options(CLI::App& command, StereoArguments& arguments);

/// Reads two photographs. Throws Error{bad_input} that names both where their sizes differ.
StereoPair read_pair(const std::string& left, const std::string& right);

/// Reads photographs from two files or one, and says on standard error how one was understood, and where the eyes look
/// swapped. Throws Error: bad_input where they are no pair, wrong_usage.
StereoPair read_photographs(const StereoArguments& arguments, const Session& session);

}  // namespace wheatstone::cli
