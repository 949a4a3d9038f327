#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>

#include "progress_display.h"

namespace wheatstone::cli {

/// Runs one command line; `arguments` are the words behind the program's name. Results go to `output`, progress and
/// errors to `errors`: a failed run ends it with one line, "wheatstone: ...", and with --json `output` is
/// {"error", "exit_code"}. May be called any number of times in a
/// process, one call at a time: a limit of threads ends with its run. Signals are the caller's: see interrupt.h.
/// `begin` is called first; what it throws is told as everything else. Returns the exit code; never throws.
int run_command_line(std::span<const std::string> arguments, std::ostream& output, std::ostream& errors,
                     ProgressDisplay::Style progress = ProgressDisplay::Style::lines,
                     const std::function<void()>& begin = {});

}  // namespace wheatstone::cli
