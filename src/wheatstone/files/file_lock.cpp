#include "wheatstone/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace wheatstone {
namespace {

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Whether the open file is the one that has this name: the run that held it before may have removed or replaced it.
bool is_there(int held, const std::filesystem::path& file) {
  struct stat own = {}, named = {};
  return ::fstat(held, &own) == 0 && ::stat(file.c_str(), &named) == 0 && own.st_dev == named.st_dev &&
         own.st_ino == named.st_ino;
}

}  // namespace

std::error_code FileLock::hold(const std::filesystem::path& file, bool waits) {
  release();
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) return last_error();
    int locked = 0;
    do locked = ::flock(descriptor, LOCK_EX | (waits ? 0 : LOCK_NB));
    while (locked != 0 && errno == EINTR);
    if (locked == 0 && is_there(descriptor, file)) {
      descriptor_ = descriptor;
      return {};
    }
    const std::error_code error = last_error();
    ::close(descriptor);
    if (locked != 0) return error;
  }
}

void FileLock::release() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

}  // namespace wheatstone
