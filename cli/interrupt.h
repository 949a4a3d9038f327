#pragma once

namespace wheatstone::cli {

/// From here on Ctrl-C, TERM and HUP are noted instead of ending the program at once; a second one ends it. A closed
/// pipe and a file beyond the user's limit become errors of the write instead of signals.
void watch_signals();

/// Throws Error{interrupted} where a signal was noted.
void throw_if_interrupted();

}  // namespace wheatstone::cli
