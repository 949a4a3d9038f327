#include "window_program.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto window_program = "wheatstone-view";

/// The window's program beside this one; else it is looked for where the shell looks.
std::string window_program_path() {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / window_program;
  return !error && fs::exists(beside, error) ? beside.string() : std::string(window_program);
}

}  // namespace

int run_window_program(std::vector<std::string> words) {
  words.insert(words.begin(), window_program_path());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_t process = 0;
  if (const int error = posix_spawnp(&process, pointers.front(), nullptr, nullptr, pointers.data(), environ);
      error != 0)
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot be started: {}; it is built and installed with "
                                                          "the window (WHEATSTONE_VIEWER)",
                                                          words.front(), std::strerror(error)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  throw Error(ErrorKind::interrupted, fmt::format("{}: ended by signal {}", window_program, WTERMSIG(status)));
}

}  // namespace wheatstone::cli
