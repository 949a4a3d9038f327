#include "wheatstone/files/text_encoding.h"

#include <fmt/format.h>

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

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

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

std::string html_head(std::string_view title, std::string_view style, std::string_view policy,
                      std::string_view scripts) {
  std::string head = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  if (!policy.empty()) head += fmt::format("<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n", policy);
  return head + fmt::format(
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
                    "<style>{}</style>\n{}</head><body>\n",
                    html_text(title), style, scripts);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

}  // namespace wheatstone
