#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"
#include "report.h"
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

/// Says a line beside the results, unless --quiet.
void remark(const Session& session, std::string_view line);

/// A command of the program: its options, and what it does once a line is understood and no option of it is without
/// effect. What it throws, wheatstone::Error, becomes one line and the exit code.
struct Command {
  std::string name, help;
  std::string footer;  ///< of the help, with examples that run
  Rows rows = {};
  Given* given = nullptr;  ///< takes which options were given, for those rows that look at it
  std::function<Report(const Session&)> run = {};
  std::vector<Command> kinds = {};  ///< commands below this one, which then does nothing itself
};

/// A command whose options `rows` binds to Arguments, with which it runs. A member `given` of Arguments tells which
/// options were given.
template <class Arguments>
Command make_command(std::string name, std::string help, Rows (*rows)(Arguments&),
                     Report (*run)(const Arguments&, const Session&), std::string footer) {
  const auto arguments = std::make_shared<Arguments>();
  Command command{std::move(name), std::move(help), std::move(footer), rows(*arguments)};
  if constexpr (requires { arguments->given; }) command.given = &arguments->given;
  command.run = [arguments, run](const Session& session) { return run(*arguments, session); };
  return command;
}

/// Adds a command, and those below it, to the parser. The session is filled when a line is parsed.
void add_command(CLI::App& above, const Command& command, const Session& session);

/// Throws what a report's exit code stands for, once it is printed.
struct ErrorTold {
  int exit_code;
};

}  // namespace wheatstone::cli
