#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace wheatstone::cli {

/// From here on Ctrl-C, TERM and HUP are noted instead of ending the program at once. A run that reports progress ends
/// itself soon after; one that is in a long call is ended 0.4 s later by another thread, which removes what is
/// unfinished, says so and leaves with the exit code of an interrupted run. A closed pipe and a file beyond the user's
/// limit become errors of the write instead of signals. `says_so`: not where the program that started this one says it.
void watch_signals(bool says_so = true);

/// From here on `told` is called in another thread when a signal comes, or at once where one came already; the run then
/// has this long to end itself, whatever it has finished. For a run that waits for another program, or for its user.
/// Empty: nobody is told.
void on_signal(std::function<void()> told, std::chrono::milliseconds most = std::chrono::milliseconds(400));

/// From here on what is thrown where nothing catches it, in a thread of a library, ends the program in one line with an
/// exit code, as any other failure, and leaves nothing unfinished. `json`: what ends the run, a signal too, is told on
/// standard output as well.
void end_in_one_line(bool json);

/// Throws Error{interrupted} where a signal was noted.
void throw_if_interrupted();

/// Throws Error{interrupted} that says what the run leaves.
[[noreturn]] void throw_interrupted();

/// What a run that is ended says of what it leaves, instead of "nothing half-written is left"; asked when it ends.
/// Empty: as usual.
void tell_what_is_kept(std::function<std::string()> kept);

/// The run is over, one way or the other, and only says so now: from here on a signal ends the program at once. Does
/// not return where another thread already ends the run. `with_others`: mpirun tells a process to end as soon as
/// another one has; signals change nothing any more.
void run_is_over(bool with_others = false);

}  // namespace wheatstone::cli
