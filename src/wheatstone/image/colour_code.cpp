#include "wheatstone/image/colour_code.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace wheatstone {

std::optional<Rgb8> colour_of_code(std::string_view code) {
  if (code.starts_with('#')) code.remove_prefix(1);
  const auto is_hexadecimal = [](unsigned char c) { return std::isxdigit(c) != 0; };
  if (code.size() != 6 || !std::ranges::all_of(code, is_hexadecimal)) return std::nullopt;
  unsigned value = 0;
  std::from_chars(code.data(), code.data() + code.size(), value, 16);
  return Rgb8{static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 0xFF),
              static_cast<std::uint8_t>(value & 0xFF)};
}

}  // namespace wheatstone
