#include "wheatstone/study/trial_log.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/study/tsv_table_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_log_bytes = std::size_t{1} << 28;
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

/// Whether a line, without its end, has all fields of a table, of which the observer is the last.
bool is_whole(std::string_view line, std::string_view header) {
  return std::ranges::count(line, '\t') == std::ranges::count(header, '\t') &&
         (line.ends_with("\tperson") || line.ends_with("\tsimulated"));
}

/// How many bytes of a table are whole lines. Where its last line has no end, another program may have saved it so.
std::size_t whole_bytes(std::string_view table) {
  const std::size_t ended = table.rfind('\n') + 1;  // 0 where there is none
  return ended > 0 && is_whole(table.substr(ended), table.substr(0, table.find('\n'))) ? table.size() : ended;
}

/// The lines in a reserve; empty where there are none, and where the table has them already. Throws Error{bad_input}
/// where they are none of the table's.
std::string kept_lines(const fs::path& reserve, std::string_view table) {
  std::error_code error;
  if (!fs::exists(reserve, error)) return {};
  const std::string bytes = read_whole_file(reserve, most_log_bytes);
  // None of them is empty.
  const std::size_t end = bytes.find("\n\n");
  std::string lines = end == std::string::npos ? bytes : bytes.substr(0, end + 1);
  if (!lines.ends_with('\n')) lines += '\n';
  if (lines.find_first_not_of('\n') == std::string::npos || table.ends_with(lines)) return {};
  const std::string_view header = table.substr(0, table.find('\n'));
  for (const std::string& line : lines_of(lines))
    if (!is_whole(line, header))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: holds no answer of this study, expected a line of the table beside it; move it away "
                              "to go on without it",
                              reserve.string()));
  return lines;
}

}  // namespace

TrialLog::TrialLog(fs::path path, std::string_view header) : path_(std::move(path)), reserve_(reserve_of(path_)) {
  if (const std::error_code error = lock_.hold(path_); error == std::errc::resource_unavailable_try_again)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: another session writes it; expected another subject, or wait until that session has "
                            "ended",
                            path_.string()));
  else if (error)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot be written: {}", path_.string(), error.message()));
  const std::string present = read_whole_file(path_, most_log_bytes);
  if (!header.starts_with(present) && !plain_text(present).starts_with(header))
    throw Error(ErrorKind::bad_input, fmt::format("{}:1: has other columns, expected {}", path_.string(),
                                                  fmt::join(fields_of(header.substr(0, header.find('\n'))), ", ")));
  size_ = whole_bytes(present);
  if (size_ < present.size() && ::ftruncate(lock_.descriptor(), static_cast<off_t>(size_)) != 0)
    fail(path_, "cannot be cut");
  if (size_ == 0)
    add(header);
  else if (present[size_ - 1] != '\n')
    add("\n");
  take_over_reserve();
  make_reserve();
}

void TrialLog::add(std::string_view bytes) {
  if (!write_at(lock_.descriptor(), bytes, size_)) fail(path_, "cannot be written");
  size_ += bytes.size();
}

void TrialLog::take_over_reserve() {
  if (const std::string lines = kept_lines(reserve_, read_whole_file(path_, most_log_bytes)); !lines.empty())
    add(lines);
}

void TrialLog::make_reserve() const {
  const int descriptor = ::open(reserve_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(reserve_, "cannot be written");
  const bool written = write_at(descriptor, std::string(reserve_bytes, '\n'), 0);
  ::close(descriptor);
  if (!written) fail(reserve_, "cannot be written");
}

void TrialLog::append(std::string_view line) {
  if (write_at(lock_.descriptor(), line, size_)) {
    size_ += line.size();
    return;
  }
  const std::string reason = std::strerror(errno);
  // The table's end is only tidied: opening it again cuts off what is half-written.
  if (::ftruncate(lock_.descriptor(), static_cast<off_t>(size_)) != 0) errno = 0;
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
  const std::string present = read_whole_file(path, most_log_bytes);
  std::string whole = present.substr(0, whole_bytes(present));
  if (!whole.empty() && whole.back() != '\n') whole += '\n';
  return whole + kept_lines(reserve_of(path), whole);
}

}  // namespace wheatstone
