#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "viewer.h"

namespace wheatstone::viewer {

/// What a script can do that only the program around the viewer can.
struct ScriptHost {
  std::function<void(const std::filesystem::path&)> screenshot;  ///< of the window; none: of the frame
  std::function<void(int width, int height)> resize;             ///< the window; none: the viewport
  std::function<void(const std::string&)> print;                 ///< a line of the result
};

/// Commands from a file, one a line, as run_line takes them, and these: `wait` goes on when nothing is being opened,
/// painted, moved or drawn, and ends the script where that failed, `wait SECONDS` after so long, `screenshot FILE`,
/// `resize WIDTH HEIGHT`, `print` prints the state as one line of JSON.
class Script {
 public:
  /// Throws Error{bad_input} where the file cannot be read.
  Script(const std::filesystem::path& path, ScriptHost host);

  /// Does what can be done without waiting. Returns whether the script is at its end. Throws Error that begins with the
  /// script's name and line.
  bool go_on(Viewer& viewer);

 private:
  void run(Viewer& viewer, const std::string& line);

  std::string name_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;
  bool waits_ = false;
  std::optional<std::chrono::steady_clock::time_point> waits_until_;
  ScriptHost host_;
};

/// Runs a script to its end, without a window.
void run_script(Viewer& viewer, const std::filesystem::path& path, ScriptHost host = {});

/// A session's state as one line of JSON: what is open, how it is shown, what was last said.
std::string state_json(const Session& session);

}  // namespace wheatstone::viewer
