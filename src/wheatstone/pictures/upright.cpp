#include "wheatstone/pictures/upright.h"

#include <cstddef>
#include <cstdint>

namespace wheatstone {
namespace {

constexpr int upright_orientation = 1;

/// A number of some bytes; 0 beyond the end.
std::size_t number_at(std::string_view exif, std::size_t at, std::size_t bytes) {
  if (at > exif.size() || bytes > exif.size() - at) return 0;
  const bool lowest_first = exif.starts_with("II");
  std::size_t number = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    number = number << 8 | static_cast<std::uint8_t>(exif[at + (lowest_first ? bytes - 1 - i : i)]);
  return number;
}

}  // namespace

int exif_orientation(std::string_view exif) {
  if (!exif.starts_with("II") && !exif.starts_with("MM")) return upright_orientation;
  constexpr std::size_t entry_bytes = 12, tag_orientation = 0x112, type_short = 3;
  const std::size_t directory = number_at(exif, 4, 4), entries = number_at(exif, directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    // Tag, type, count, value.
    const std::size_t entry = directory + 2 + i * entry_bytes;
    if (number_at(exif, entry, 2) != tag_orientation) continue;
    const std::size_t value = number_at(exif, entry + 8, 2);
    const bool valid = number_at(exif, entry + 2, 2) == type_short && value >= 1 && value <= 8;
    return valid ? static_cast<int>(value) : upright_orientation;
  }
  return upright_orientation;
}

}  // namespace wheatstone
