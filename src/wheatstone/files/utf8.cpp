#include "wheatstone/files/utf8.h"

#include <algorithm>

namespace wheatstone {

std::size_t utf8_character_bytes(std::string_view text) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return 0;
  const unsigned char second = byte(1);
  const bool second_fits = !(first == 0xE0 && second < 0xA0) && !(first == 0xED && second > 0x9F) &&
                           !(first == 0xF0 && second < 0x90) && !(first == 0xF4 && second > 0x8F);
  const bool all_follow =
      std::ranges::all_of(text.substr(1, bytes - 1), [](unsigned char c) { return (c & 0xC0) == 0x80; });
  return second_fits && all_follow ? bytes : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = utf8_character_bytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

}  // namespace wheatstone
