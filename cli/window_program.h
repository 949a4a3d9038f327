#pragma once

#include <string>
#include <vector>

namespace wheatstone::cli {

/// Starts the window's program with these words, which needs a window system that this one does without, and waits for
/// it. Returns its exit code; throws Error where it cannot be started or was ended by a signal.
int run_window_program(std::vector<std::string> words);

}  // namespace wheatstone::cli
