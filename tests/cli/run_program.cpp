#include "cli/run_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "cli/run.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

void redirect(int descriptor, const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(127);
  ::close(file);
}

[[noreturn]] void become_program(std::vector<std::string> words, const ProgramRun& run, const fs::path& output,
                                 const fs::path& errors) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // A test runner may ignore what the program is to notice.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(number, SIG_DFL);
  redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
  redirect(STDOUT_FILENO, output, O_WRONLY | O_CREAT);
  redirect(STDERR_FILENO, errors, O_WRONLY | O_CREAT);
  const rlimit limit = {run.largest_file, run.largest_file};
  if (run.largest_file > 0 && ::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(127);
  const rlimit addresses = {run.most_addresses, run.most_addresses};
  if (run.most_addresses > 0 && ::setrlimit(RLIMIT_AS, &addresses) != 0) ::_exit(127);
  if (run.while_running) {
    // A program that is stopped amid its work keeps its memory, and its threads run on while a sanitizer looks for
    // leaks.
    const char* const options = std::getenv("ASAN_OPTIONS");
    ::setenv("ASAN_OPTIONS", (std::string(options ? options : "") + ":detect_leaks=0").c_str(), 1);
  }
  if (::chdir(run.folder.c_str()) == 0) ::execv(arguments.front(), arguments.data());
  ::_exit(127);
}

/// Sends a descriptor of this process into a file as long as it lives.
class RedirectedDescriptor {
 public:
  RedirectedDescriptor(int descriptor, const fs::path& path) : descriptor_(descriptor), before_(::dup(descriptor)) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
    if (before_ < 0 || file < 0 || ::dup2(file, descriptor) < 0) throw std::runtime_error("cannot redirect");
    ::close(file);
  }
  ~RedirectedDescriptor() {
    ::dup2(before_, descriptor_);
    ::close(before_);
  }
  RedirectedDescriptor(const RedirectedDescriptor&) = delete;
  RedirectedDescriptor& operator=(const RedirectedDescriptor&) = delete;

 private:
  int descriptor_;
  int before_;
};

class CurrentFolder {
 public:
  explicit CurrentFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~CurrentFolder() { fs::current_path(before_); }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;

 private:
  fs::path before_;
};

ProgramResult run_here(const std::vector<std::string>& arguments, const fs::path& folder,
                       cli::ProgressDisplay::Style progress) {
  const TemporaryFolder scratch;
  ProgramResult result;
  std::ostringstream output;
  std::ostringstream errors;
  std::fflush(nullptr);
  {
    // What a library prints past the streams would reach the user, too.
    const RedirectedDescriptor direct_output(STDOUT_FILENO, scratch / "output");
    const RedirectedDescriptor direct_errors(STDERR_FILENO, scratch / "errors");
    const CurrentFolder inside(folder);
    result.exit_code = cli::run_command_line(arguments, output, errors, progress);
    std::fflush(nullptr);
  }
  result.output = bytes_of(scratch / "output") + output.str();
  result.errors = bytes_of(scratch / "errors") + errors.str();
  return result;
}

ProgramResult run_in_own_process(const std::vector<std::string>& arguments, const ProgramRun& run) {
  const TemporaryFolder scratch;
  std::vector<std::string> words = {WHEATSTONE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const fs::path output = run.standard_output.empty() ? scratch / "output" : run.standard_output;

  const pid_t process = ::fork();
  if (process == 0) become_program(words, run, output, scratch / "errors");
  if (process > 0 && run.while_running) run.while_running(process);
  int status = 0;
  rusage usage{};
  if (process < 0 || ::wait4(process, &status, 0, &usage) != process)
    throw std::runtime_error("cannot run the program");
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
  result.errors = bytes_of(scratch / "errors");
  if (run.standard_output.empty()) result.output = bytes_of(output);
  return result;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramRun& run) {
  const bool here = !run.own_process && run.standard_output.empty() && run.largest_file == 0 &&
                    run.most_addresses == 0 && !run.while_running;
  using Style = cli::ProgressDisplay::Style;
  return here ? run_here(arguments, run.folder, run.every_step ? Style::every_step : Style::lines)
              : run_in_own_process(arguments, run);
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    names.insert(fs::relative(entry.path(), folder).string());
  }
  return names;
}

void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::string& part) {
  std::string line = "wheatstone";
  for (const std::string& argument : arguments) line += " " + argument;
  SCOPED_TRACE(line);
  const std::set<std::string> before = files_in(folder / "");
  const ProgramResult result = run_program(arguments, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, exit_code) << result.errors;
  EXPECT_THAT(result.errors, testing::StartsWith("wheatstone: "));
  EXPECT_THAT(result.errors, testing::HasSubstr(part));
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  const bool as_json = std::ranges::find(arguments, "--json") != arguments.end();
  EXPECT_EQ(result.output.substr(0, 13), as_json ? "{\n  \"error\": " : "");
  EXPECT_EQ(files_in(folder / ""), before);
}

std::vector<std::string> commands() {
  std::istringstream help(run_program({"--help"}).output);
  std::vector<std::string> names;
  std::string line;
  while (std::getline(help, line) && line != "Commands:") continue;
  while (std::getline(help, line) && line.starts_with("  ")) {
    // A name stands two columns in; a description's next line stands further in.
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

}  // namespace wheatstone
