#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <iosfwd>

#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone::cli {

/// What every command shares; filled from the command line before a command runs. Commands print to its streams only.
struct Session {
  std::ostream& output;  ///< takes the results
  std::ostream& errors;  ///< takes what is said beside them
  bool json = false;     ///< print one JSON object as the output instead of text
  bool verbose = false;
  bool quiet = false;  ///< no progress and no remarks, only errors
  int threads = 0;     ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  Ranks ranks;        ///< the processes of mpirun that share the work; their commands run alike, and the first writes
  Progress progress;  ///< draws the bar and throws Error{interrupted} after Ctrl-C
  std::function<void()> clear_progress;  ///< takes the bar away, before something else is said on `errors`
};

/// Ends a command that has said itself what went wrong.
struct ErrorTold {
  int exit_code;
};

// Each adds its command to the program. A command throws wheatstone::Error; run_command_line turns that into one line
// and the exit code. The session outlives the commands and is filled when their callbacks run.
void add_calibrate_command(CLI::App& program, const Session& session);
void add_rectify_command(CLI::App& program, const Session& session);
void add_match_command(CLI::App& program, const Session& session);
void add_paint_command(CLI::App& program, const Session& session);
void add_pack_command(CLI::App& program, const Session& session);
void add_rotoscope_command(CLI::App& program, const Session& session);
void add_render_command(CLI::App& program, const Session& session);
void add_share_command(CLI::App& program, const Session& session);
void add_depth_command(CLI::App& program, const Session& session);
void add_measure_command(CLI::App& program, const Session& session);
void add_synth_command(CLI::App& program, const Session& session);
void add_study_command(CLI::App& program, const Session& session);
void add_view_command(CLI::App& program, const Session& session);
void add_info_command(CLI::App& program, const Session& session);

}  // namespace wheatstone::cli
