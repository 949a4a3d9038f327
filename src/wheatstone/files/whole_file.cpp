#include "wheatstone/files/whole_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/temporary_file.h"

namespace wheatstone {

std::string read_whole_file(const std::filesystem::path& path, std::size_t most_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is a folder, expected a file", path.string()));
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: cannot be opened: {}", path.string(), std::generic_category().message(errno)));
  const auto size = static_cast<std::size_t>(file.tellg());
  if (size > most_bytes)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {} bytes long, expected at most {}", path.string(), size, most_bytes));
  std::string bytes(size, '\0');
  file.seekg(0);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw Error(ErrorKind::bad_input, fmt::format("{}: cannot be read to its end", path.string()));
  return bytes;
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  TemporaryFile temporary(path);
  std::ofstream file(temporary.path(), std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(errno)));
  temporary.commit();
}

}  // namespace wheatstone
