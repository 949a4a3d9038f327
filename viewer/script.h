#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer.h"

namespace wheatstone::viewer {

/// What lines can do that only the program around the viewer can.
struct ScriptHost {
  std::function<void()> show = {};  ///< what lines have changed, before it is asked whether anything is still pending
  std::function<void(const std::filesystem::path&)> screenshot = {};  ///< of the window; none: of the frame
  std::function<void(int width, int height)> resize = {};             ///< the window; none: the viewport
  std::function<void(const std::string&)> print = {};                 ///< a line of the result
  /// What is measured of the window, which `print` tells, too.
  std::function<std::vector<std::pair<std::string, double>>()> measured = {};
};

/// Does one line after the other: commands, as run_line takes them, which are done when what they save is written, and
/// these: `wait` is done when nothing is being opened, painted, moved or drawn, `wait SECONDS` after so long,
/// `screenshot FILE`, `resize WIDTH HEIGHT`, `print` prints the state as one line of JSON.
class LineRunner {
 public:
  explicit LineRunner(ScriptHost host = {}) : host_(std::move(host)) {}

  /// Begins a line; to be called when the one before is done. Throws Error as run_line does.
  void begin(Viewer& viewer, const std::string& line);
  /// Whether what was begun is done. Throws Error{bad_input} where what was waited for failed, once, and the error of
  /// what could not be saved.
  bool is_done(Viewer& viewer);

 private:
  ScriptHost host_;
  bool waits_ = false, saves_ = false;
  std::optional<std::chrono::steady_clock::time_point> waits_until_;
};

/// A session's state as one line of JSON: what is open, how it is shown, what was last said, and what was measured.
std::string state_json(const Viewer& viewer, const std::vector<std::pair<std::string, double>>& measured = {});

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
