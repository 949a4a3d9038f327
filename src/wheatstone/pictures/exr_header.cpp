#include "wheatstone/pictures/exr_header_internal.h"

#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace wheatstone {
namespace {

/// The lowest byte first, as the whole file is.
std::int64_t number(std::istream& file) {
  std::array<char, 4> bytes{};
  file.read(bytes.data(), bytes.size());
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value |= static_cast<std::uint32_t>(static_cast<std::uint8_t>(bytes[i])) << 8 * i;
  return static_cast<std::int32_t>(value);
}

/// Whether an attribute, whose name has been read, ends within the file; `file` stands behind it then.
bool attribute_fits(std::istream& file, std::int64_t end) {
  std::string type;
  std::getline(file, type, '\0');
  const std::int64_t bytes = number(file);
  if (!file || bytes < 0 || bytes > end - static_cast<std::int64_t>(file.tellg())) return false;
  file.seekg(bytes, std::ios::cur);
  return true;
}

}  // namespace

bool exr_header_fits(std::istream& file) {
  std::array<char, 4> magic{};
  file.read(magic.data(), magic.size());
  if (!file || std::string_view(magic.data(), magic.size()) != "\x76\x2f\x31\x01") return true;
  constexpr std::int64_t several_parts = 0x1000;
  const bool has_several = (number(file) & several_parts) != 0;
  file.seekg(0, std::ios::end);
  const std::int64_t end = file.tellg();
  file.seekg(8);

  // An empty name ends the attributes of a part, and where there may be several parts, the next one ends the header.
  std::string name;
  bool begins = true;
  while (std::getline(file, name, '\0')) {
    if (name.empty() && (begins || !has_several)) return true;
    begins = name.empty();
    if (!begins && !attribute_fits(file, end)) return false;
  }
  return false;
}

}  // namespace wheatstone
