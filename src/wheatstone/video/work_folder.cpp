#include "wheatstone/video/work_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& output, int error) {
  throw Error(ErrorKind::cannot_read_write,
              fmt::format("{}: cannot write: {}", output.string(), std::generic_category().message(error)));
}

/// Whether the file that is held is the one that has this name: the run that held it before may have removed it.
bool is_there(int held, const fs::path& file) {
  struct stat own = {}, named = {};
  return ::fstat(held, &own) == 0 && ::stat(file.c_str(), &named) == 0 && own.st_ino == named.st_ino;
}

}  // namespace

fs::path work_folder_of(const fs::path& output) { return output.string() + ".part"; }

WorkFolder::WorkFolder(fs::path output) : folder_(work_folder_of(output)) {
  const auto hold = hold_outputs();
  unfinished_.begin(folder_, [&] { take(output); });
  unfinished_.keep(true);
}

/// Makes the folder where there is none, and locks it.
void WorkFolder::take(const fs::path& output) {
  const fs::path file = folder_ / "lock";
  for (;;) {
    std::error_code error;
    fs::create_directory(folder_, error);
    if (error) fail(output, error.value());
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == ENOENT) continue;
    if (lock_ < 0) fail(output, errno);
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
      ::close(lock_);
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: another run is painting it; expected another name, or wait until that run has ended",
                              output.string()));
    }
    if (is_there(lock_, file)) break;
    ::close(lock_);
  }
}

WorkFolder::~WorkFolder() {
  unfinished_.keep(true);
  if (lock_ >= 0) ::close(lock_);
}

void WorkFolder::remove() {
  const auto hold = hold_outputs();
  // While it is held: another run must not begin in a folder that is going away.
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  unfinished_.finish([] {});
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

}  // namespace wheatstone
