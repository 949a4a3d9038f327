#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "temporary_folder.h"

namespace wheatstone {

/// What a run of the program left to its caller.
struct ProgramResult {
  int exit_code = 0;  ///< 128 + the signal where one ended the program
  std::string output;
  std::string errors;
  std::size_t peak_bytes = 0;  ///< of memory in use at any time; only of a run in a process of its own
};

struct ProgramRun {
  std::filesystem::path folder = ".";
  bool every_step = false;  ///< standard error names each step, also of a short run; in this process only
  // What needs a process of its own:
  bool own_process = false;
  std::filesystem::path standard_output;           ///< takes the output instead of the result, where it is given
  std::size_t largest_file = 0;                    ///< in bytes, 0 for no limit; a write beyond fails as on a full disk
  std::size_t most_addresses = 0;                  ///< in bytes, 0 for no limit, as ulimit -v has it
  std::function<void(int process)> while_running;  ///< called once the program has started
};

/// Runs `wheatstone ARGUMENTS` and waits for it: in this process, through the function that main calls, which spares
/// the start; or in a process of its own where `run` asks for what needs one.
ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramRun& run = {});

/// The names of all files in a folder and below it.
std::set<std::string> files_in(const std::filesystem::path& folder);

/// Runs the program in `folder` and expects that it ends with `exit_code`, writes exactly one line on standard error,
/// "wheatstone: …" with `part` in it, writes nothing on standard output but the error that --json asks for, and leaves
/// no file that was not there before.
void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::string& part);

/// The commands that `wheatstone --help` lists.
std::vector<std::string> commands();

}  // namespace wheatstone
