#include "wheatstone/files/html_text.h"

#include <algorithm>

#include "wheatstone/files/utf8.h"

namespace wheatstone {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

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
    const std::size_t bytes = utf8_character_bytes(text);
    const std::string_view instead = bytes == 0 ? replacement : escaped(text.front());
    result += instead.empty() ? text.substr(0, bytes) : instead;
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

}  // namespace wheatstone
