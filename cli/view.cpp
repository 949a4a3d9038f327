#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "view_arguments.h"
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

/// Starts the window's program, which needs a window system that this one does without, and waits for it.
int run_window(std::vector<std::string> words) {
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

void view(ViewArguments arguments, const Session& session) {
  for (const std::string& file : arguments.files)
    if (!fs::exists(file) && file.find_first_of("%,") == std::string::npos)
      throw Error(ErrorKind::bad_input, fmt::format("{}: no such file", file));
  arguments.threads = session.threads;
  arguments.seed = session.seed;
  session.output.flush();
  if (const int code = run_window(view_words(arguments)); code != 0) throw ErrorTold{code};
}

}  // namespace

void add_view_command(CLI::App& program, const Session& session) {
  CLI::App* const command =
      program.add_subcommand("view", "Open paintings, photographs, films, slices or particles in a window");
  const auto arguments = std::make_shared<ViewArguments>();
  add_view_options(*command, *arguments);
  command->callback([arguments, &session] { view(*arguments, session); });
}

}  // namespace wheatstone::cli
