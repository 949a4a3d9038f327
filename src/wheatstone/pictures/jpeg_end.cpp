#include <cstdint>

#include "wheatstone/pictures/jpeg_end_internal.h"

namespace wheatstone {

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8"); }

bool jpeg_is_whole(std::string_view bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  if (bytes.size() < 4 || !is_jpeg(bytes)) return true;
  constexpr std::uint8_t start_of_scan = 0xDA;

  // Segments with a length come first; a thumbnail with an end marker of its own may hide in them.
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    if (byte(at) != 0xFF) return false;
    const std::uint8_t marker = byte(at + 1);
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    at += 2 + (static_cast<std::size_t>(byte(at + 2)) << 8 | byte(at + 3));
    if (marker == start_of_scan) return bytes.find("\xFF\xD9", at) != std::string_view::npos;
  }
  return false;
}

}  // namespace wheatstone
