#include "wheatstone/files/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// What the new process does between fork and exec: calls that are safe while other threads hold locks, and no others.
[[noreturn]] void become(char* const* words, pid_t parent, int told) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  // A parent that ended before this line sends no signal.
  if (::getppid() != parent) ::_exit(127);
  ::execvp(words[0], words);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(told, &error, sizeof error);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // The end that the new process writes to is closed by exec: nothing to read says that it has begun.
  std::array<int, 2> ends{};
  int error = ::pipe2(ends.data(), O_CLOEXEC) == 0 ? 0 : errno;
  if (error == 0) {
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) become(pointers.data(), parent, ends[1]);
    if (process_ < 0) error = errno;
    ::close(ends[1]);
    if (process_ > 0) {
      ssize_t count = 0;
      do count = ::read(ends[0], &error, sizeof error);
      while (count < 0 && errno == EINTR);
      if (count > 0) wait();
    }
    ::close(ends[0]);
  }
  if (error != 0)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot be started: {}", words.front(), std::generic_category().message(error)));
}

int ChildProcess::wait() const {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

void ChildProcess::signal(int number) const { ::kill(process_, number); }

}  // namespace wheatstone
