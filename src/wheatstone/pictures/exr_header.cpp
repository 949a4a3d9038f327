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

constexpr std::string_view too_long = "its header is longer than the file";

/// What is wrong with a list of channels that ends at `end`: a name, a kind of numbers, and twelve bytes for each.
std::string_view channels_complaint(std::istream& file, std::int64_t end) {
  constexpr std::int64_t kinds = 3, rest = 12;  // integers, halves and floats
  std::string name;
  while (file.tellg() < end && std::getline(file, name, '\0') && !name.empty()) {
    const std::int64_t kind = number(file);
    if (!file || kind < 0 || kind >= kinds) return "a channel's numbers are of an unknown kind";
    file.seekg(rest, std::ios::cur);
  }
  return {};
}

/// What is wrong with an attribute whose name has been read; `file` stands behind it where nothing is.
std::string_view attribute_complaint(std::istream& file, std::int64_t end) {
  std::string type;
  std::getline(file, type, '\0');
  const std::int64_t bytes = number(file);
  const std::int64_t begin = file.tellg();
  if (!file || bytes < 0 || bytes > end - begin) return too_long;
  if (type == "chlist")
    if (const std::string_view complaint = channels_complaint(file, begin + bytes); !complaint.empty())
      return complaint;
  file.seekg(begin + bytes);
  return {};
}

}  // namespace

std::string exr_header_complaint(std::istream& file) {
  std::array<char, 4> magic{};
  file.read(magic.data(), magic.size());
  if (!file || std::string_view(magic.data(), magic.size()) != "\x76\x2f\x31\x01") return {};
  constexpr std::int64_t several_parts = 0x1000;
  const bool has_several = (number(file) & several_parts) != 0;
  file.seekg(0, std::ios::end);
  const std::int64_t end = file.tellg();
  file.seekg(8);

  // An empty name ends the attributes of a part, and where there may be several parts, the next one ends the header.
  std::string name;
  bool begins = true;
  while (std::getline(file, name, '\0')) {
    if (name.empty() && (begins || !has_several)) return {};
    begins = name.empty();
    if (begins) continue;
    if (const std::string_view complaint = attribute_complaint(file, end); !complaint.empty())
      return std::string(complaint);
  }
  return std::string(too_long);
}

}  // namespace wheatstone
