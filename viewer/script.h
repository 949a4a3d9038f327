#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "line_runner.h"

namespace wheatstone::viewer {

/// Lines from a file, as LineRunner does them. The first that fails ends the script.
class Script {
 public:
  /// Throws Error{bad_input} where the file cannot be read.
  Script(const std::filesystem::path& path, ScriptHost host);

  /// Does what can be done without waiting. Returns whether the script is at its end. Throws Error that begins with the
  /// script's name and line.
  bool go_on(Viewer& viewer);

 private:
  std::string name_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;
  LineRunner runner_;
};

/// Runs a script to its end, without a window.
void run_script(Viewer& viewer, const std::filesystem::path& path, ScriptHost host = {});

}  // namespace wheatstone::viewer
