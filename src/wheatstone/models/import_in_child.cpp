#include "wheatstone/models/import_in_child_internal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/field_bytes.h"
#include "wheatstone/files/module.h"

namespace wheatstone {
namespace {

std::size_t page_bytes() { return static_cast<std::size_t>(::sysconf(_SC_PAGE_SIZE)); }

/// The addresses that this process has taken.
std::size_t address_space_taken() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * page_bytes();
}

void limit(__rlimit_resource resource, rlim_t to) {
  rlimit limits{};
  ::getrlimit(resource, &limits);
  limits.rlim_cur = std::min(to, limits.rlim_max);
  ::setrlimit(resource, &limits);
}

void write_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// What the child does. It writes no files, and what the importer prints is not seen.
[[noreturn]] void be_child(ImportModel& import_model, const std::string& file, const std::string& format,
                           const ImportLimits& limits, int to) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
    ::signal(number, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_AS, address_space_taken() + limits.memory_bytes);
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.seconds));
  FieldWriter writer;
  try {
    RawModel model;
    try {
      import_model(file, format, model);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      model = {};
      model.complaint = error.what();
    }
    // The importer itself may catch it and go on.
    if (model.complaint.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    writer(model);
  } catch (const std::bad_alloc&) {
    ::_exit(ENOMEM);
  }
  write_all(to, writer.bytes);
  ::_exit(0);
}

/// Ends the child where its parent has enough of it.
class Child {
 public:
  explicit Child(pid_t process) : process_(process) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ > 0) end();
  }
  /// Its status as waitpid has it.
  int end() {
    ::kill(process_, SIGKILL);
    return wait();
  }
  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    process_ = 0;
    return status;
  }

 private:
  pid_t process_;
};

struct ReadingEnd {
  int file;
  ~ReadingEnd() { ::close(file); }
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", file.string(), why));
}

std::string too_long(const ImportLimits& limits) {
  return fmt::format("reading the model takes longer than {} s, expected a file that is not damaged", limits.seconds);
}

/// All that the child writes.
std::string read_from(int from, const ImportLimits& limits, const std::filesystem::path& file,
                      const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr int heartbeat_ms = 100;
  const Clock::time_point last = Clock::now() + std::chrono::seconds(3 * limits.seconds);
  std::string bytes;
  std::vector<char> part(1 << 20);
  for (;;) {
    report(progress, "reading the model", 0);
    pollfd wait{from, POLLIN, 0};
    if (::poll(&wait, 1, heartbeat_ms) == 0 || (wait.revents & (POLLIN | POLLHUP)) == 0) {
      if (Clock::now() > last) refuse(file, too_long(limits));
      continue;
    }
    const ssize_t count = ::read(from, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    if (bytes.size() + static_cast<std::size_t>(count) > limits.memory_bytes)
      refuse(file, "reading the model takes too much memory");
    bytes.append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

ImportLimits import_limits(std::uint64_t file_bytes) {
  const std::size_t memory = static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) * page_bytes();
  ImportLimits limits;
  limits.memory_bytes = std::max(std::min(limits.memory_bytes, memory / 2), memory / 4);
  constexpr std::uint64_t bytes_a_second = 1 << 20;
  limits.seconds += static_cast<int>(std::min<std::uint64_t>(file_bytes / bytes_a_second, 3600));
  return limits;
}

RawModel import_in_child(const std::filesystem::path& file, const std::string& format, const ImportLimits& limits,
                         const Progress& progress) {
  // Loaded here: a child of a process with threads should load nothing.
  auto* const import_model =
      reinterpret_cast<ImportModel*>(function_of_module(model_module_name, import_model_name, model_module_bytes));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("cannot open a pipe: {}", std::generic_category().message(errno)));
  const pid_t process = ::fork();
  if (process == 0) be_child(*import_model, file.string(), format, limits, ends[1]);
  const int error = errno;
  ::close(ends[1]);
  const ReadingEnd from{ends[0]};
  if (process < 0)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("cannot start a process: {}", std::generic_category().message(error)));
  Child child(process);
  const std::string bytes = read_from(from.file, limits, file, progress);
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == ENOMEM)
    refuse(file, fmt::format("reading the model takes more than {:.1f} GB of memory, expected a file that is not "
                             "damaged",
                             static_cast<double>(limits.memory_bytes) / 1e9));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) refuse(file, too_long(limits));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    refuse(file, fmt::format("is damaged: reading it as {} ended with an error of the importer", format));
  RawModel model;
  FieldReader reader(bytes, fmt::format("{}: is damaged: what the importer made of it is incomplete", file.string()));
  reader(model);
  reader.expect_end();
  if (!model.complaint.empty()) {
    std::ranges::replace(model.complaint, '\n', ' ');
    refuse(file, fmt::format("cannot be read as {}: {}", format, model.complaint));
  }
  return model;
}

}  // namespace wheatstone
