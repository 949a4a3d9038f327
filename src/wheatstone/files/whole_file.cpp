#include "wheatstone/files/whole_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"

namespace wheatstone {

namespace {

namespace fs = std::filesystem;

std::string_view word_for(fs::file_type type) {
  if (type == fs::file_type::directory) return "is a folder";
  if (type == fs::file_type::fifo) return "is a pipe";
  if (type == fs::file_type::socket) return "is a socket";
  return "is a device";
}

}  // namespace

void check_plain_file(const fs::path& path, std::string_view expected, Pipes pipes) {
  const auto refuse = [&](std::string_view what) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}, expected {}", path.string(), what, expected));
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) refuse("no such file");
  const bool is_plain = fs::is_regular_file(status), is_pipe = fs::is_fifo(status) && pipes == Pipes::accepted;
  if (fs::exists(status) && !is_plain && !is_pipe) refuse(word_for(status.type()));
  if (::access(path.c_str(), R_OK) != 0) {
    const std::string reason = std::generic_category().message(errno);
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: cannot read: {}", path.string(), reason));
  }
  if (is_plain && fs::file_size(path, error) == 0) refuse("is empty");
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_pipe_bytes = std::size_t{64} << 20;

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), what));
}

/// A pipe that was read holds nothing any more: to open it again could mean to wait for ever.
void claim_pipe(const fs::path& path) {
  static std::mutex mutex;
  static std::set<std::pair<dev_t, ino_t>> claimed;
  struct stat facts = {};
  if (::stat(path.c_str(), &facts) != 0) return;
  const std::scoped_lock lock(mutex);
  if (!claimed.emplace(facts.st_dev, facts.st_ino).second)
    refuse(path, "is a pipe, which can be read only once; expected a plain file");
}

/// All that a pipe holds until it is closed.
std::string read_pipe(const fs::path& path, std::ifstream& file, std::size_t most_bytes) {
  std::string bytes;
  std::array<char, 1 << 16> part{};
  while (file.read(part.data(), part.size()) || file.gcount() > 0) {
    bytes.append(part.data(), static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > most_bytes) refuse(path, fmt::format("is a pipe of more than {} bytes", most_bytes));
  }
  return bytes;
}

}  // namespace

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

std::string read_whole_file(const fs::path& path, std::size_t most_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::is_regular_file(status) && fs::exists(status)) check_plain_file(path, "a file", Pipes::accepted);
  if (fs::is_fifo(status)) claim_pipe(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, fmt::format("cannot be opened: {}", std::generic_category().message(errno)));
  if (fs::is_fifo(status)) return read_pipe(path, file, std::min(most_bytes, most_pipe_bytes));
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::size_t>(file.tellg());
  if (size > most_bytes) refuse(path, fmt::format("is {} bytes long, expected at most {}", size, most_bytes));
  std::string bytes(size, '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) refuse(path, "cannot be read to its end");
  return bytes;
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  write_whole_file(path, std::span(&bytes, 1));
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::string_view> parts) {
  TemporaryFile temporary(path);
  std::ofstream file(temporary.path(), std::ios::binary);
  for (const std::string_view bytes : parts) file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(errno)));
  temporary.commit();
}

}  // namespace wheatstone
