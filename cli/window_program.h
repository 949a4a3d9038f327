#pragma once

#include <string>
#include <vector>

#include "command.h"

namespace wheatstone::cli {

/// Starts the window's program with these words, which needs a window system that this one does without, and waits for
/// it. The report has its exit code; throws Error where it cannot be started or was interrupted.
Report run_window_program(std::vector<std::string> words, const Session& session);

}  // namespace wheatstone::cli
