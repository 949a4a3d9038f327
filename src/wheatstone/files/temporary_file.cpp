#include "wheatstone/files/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& path, int error) {
  const std::string reason = std::generic_category().message(error);
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot write: {}", path.string(), reason));
}

// Hidden, so that a folder watched by a viewer does not show it; unique among processes and within this one.
fs::path temporary_name(const fs::path& final_path) {
  static std::atomic<unsigned> count = 0;
  const std::string name = fmt::format(".{}.{}-{}.partial{}", final_path.stem().string(), ::getpid(), count++,
                                       final_path.extension().string());
  return final_path.parent_path() / name;
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path final_path) : name_(std::move(final_path)), final_path_(name_) {
  std::error_code error;
  const fs::file_status status = fs::status(final_path_, error);
  if (fs::is_directory(status)) fail_to_write(final_path_, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    temporary_path_ = final_path_;
    return;
  }

  // A link keeps pointing at its target: the target is what is replaced, or made.
  if (fs::is_symlink(fs::symlink_status(final_path_, error))) final_path_ = followed(final_path_);
  temporary_path_ = temporary_name(final_path_);
  unfinished_.begin(temporary_path_, [this] {
    const int file = ::open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) fail_to_write(final_path_, errno);
    ::close(file);
  });
}

void TemporaryFile::commit() {
  unfinished_.finish([this] {
    std::error_code error;
    fs::rename(temporary_path_, final_path_, error);
    if (error) fail_to_write(final_path_, error.value());
  });
}

}  // namespace wheatstone
