#include "wheatstone/study/trial_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 28;
constexpr std::size_t reserve_bytes = 4096;

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno)));
}

/// Writes all bytes at a place of a file and waits until the disk has them; false where it does not take them.
bool write_at(int descriptor, std::string_view bytes, std::size_t place) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    place += static_cast<std::size_t>(written);
  }
  return ::fsync(descriptor) == 0 || errno == EINVAL;  // EINVAL: a file that cannot be synced
}

fs::path reserve_of(const fs::path& path) {
  return path.parent_path() / fmt::format(".{}.reserve", path.filename().string());
}

/// The line in a reserve; empty where there is none.
std::string kept_line(const fs::path& reserve) {
  std::error_code error;
  if (!fs::exists(reserve, error)) return {};
  const std::string bytes = read_whole_file(reserve, most_bytes);
  const std::size_t end = bytes.find('\n');
  return end == std::string::npos || end == 0 ? std::string() : bytes.substr(0, end + 1);
}

}  // namespace

TrialLog::TrialLog(fs::path path, std::string_view header) : path_(std::move(path)), reserve_(reserve_of(path_)) {
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(path_, "cannot be written");
  const std::string present = read_whole_file(path_, most_bytes);
  size_ = present.rfind('\n') + 1;  // 0 where there is none
  if (size_ < present.size() && ::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) fail(path_, "cannot be cut");
  if (size_ == 0) {
    if (!write_at(descriptor_, header, 0)) fail(path_, "cannot be written");
    size_ = header.size();
  }
  take_over_reserve();
  make_reserve();
}

TrialLog::~TrialLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TrialLog::take_over_reserve() {
  const std::string line = kept_line(reserve_);
  if (line.empty()) return;
  if (!write_at(descriptor_, line, size_)) fail(path_, "cannot be written");
  size_ += line.size();
}

void TrialLog::make_reserve() const {
  const int descriptor = ::open(reserve_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(reserve_, "cannot be written");
  const bool written = write_at(descriptor, std::string(reserve_bytes, '\n'), 0);
  ::close(descriptor);
  if (!written) fail(reserve_, "cannot be written");
}

void TrialLog::append(std::string_view line) {
  if (write_at(descriptor_, line, size_)) {
    size_ += line.size();
    return;
  }
  const std::string reason = std::strerror(errno);
  // The table's end is only tidied: opening it again cuts off what is half-written.
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) errno = 0;
  const int reserve = ::open(reserve_.c_str(), O_WRONLY | O_CLOEXEC);
  const bool kept = reserve >= 0 && line.size() < reserve_bytes && write_at(reserve, line, 0);
  if (reserve >= 0) ::close(reserve);
  throw Error(
      ErrorKind::cannot_read_write,
      fmt::format("{}: cannot be written: {}; {}", path_.string(), reason,
                  kept ? fmt::format("the answer is kept in {}, and the study goes on from there when it is run again",
                                     reserve_.string())
                       : fmt::format("the answer is: {}", line.substr(0, line.find('\n')))));
}

void TrialLog::finish() {
  std::error_code ignored;
  fs::remove(reserve_, ignored);
}

std::string read_trial_log(const fs::path& path) {
  const std::string present = read_whole_file(path, most_bytes);
  return present.substr(0, present.rfind('\n') + 1) + kept_line(reserve_of(path));
}

}  // namespace wheatstone
