#include "wheatstone/files/plain_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "wheatstone/error.h"

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

}  // namespace wheatstone
