#include "window_program.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "interrupt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/child_process.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto window_program = "wheatstone-view";
constexpr std::chrono::milliseconds patience{900};  ///< for the window to end, which ends itself sooner

/// The window's program beside this one; else it is looked for where the shell looks.
std::string window_program_path() {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / window_program;
  return !error && fs::exists(beside, error) ? beside.string() : std::string(window_program);
}

std::unique_ptr<const ChildProcess> start(std::vector<std::string> words) {
  try {
    return std::make_unique<const ChildProcess>(std::move(words));
  } catch (const Error& error) {
    throw Error(error.kind(),
                fmt::format("{}; it is built and installed with the window (WHEATSTONE_VIEWER)", error.what()));
  }
}

}  // namespace

Report run_window_program(std::vector<std::string> words, const Session& session) {
  session.output.flush();
  words.insert(words.begin(), window_program_path());
  throw_if_interrupted();
  const std::unique_ptr<const ChildProcess> window = start(std::move(words));
  on_signal([&window] { window->signal(SIGTERM); }, patience);
  const int status = window->wait();
  on_signal({});
  // The window's program leaves it to this one to say so.
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ErrorKind::interrupted)) throw_interrupted();
  if (WIFEXITED(status)) return {.facts = {}, .exit_code = WEXITSTATUS(status)};
  throw_if_interrupted();
  const std::string end = fmt::format("{}: ended by signal {}", window_program, WTERMSIG(status));
  constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGKILL};
  if (std::ranges::find(ending_signals, WTERMSIG(status)) == ending_signals.end()) throw std::runtime_error(end);
  throw Error(ErrorKind::interrupted, end);
}

}  // namespace wheatstone::cli
