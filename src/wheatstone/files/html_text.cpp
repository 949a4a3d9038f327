#include "wheatstone/files/html_text.h"

#include <algorithm>

namespace wheatstone {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

/// The bytes of the character that the text begins with; 0 where it begins with none (RFC 3629, section 4).
std::size_t character_bytes(std::string_view text) {
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

std::string_view escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    const std::string_view instead = bytes == 0 ? replacement : escaped(text.front());
    result += instead.empty() ? text.substr(0, bytes) : instead;
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

}  // namespace wheatstone
