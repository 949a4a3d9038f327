#include "size_argument.h"

#include <fmt/format.h>

#include <charconv>

#include "wheatstone/error.h"

namespace wheatstone::cli {

void take_size(const std::string& text, int& width, int& height) {
  const char* const end = text.data() + text.size();
  const auto [after_width, width_error] = std::from_chars(text.data(), end, width);
  bool whole = width_error == std::errc() && after_width != end && *after_width == 'x';
  if (whole) {
    const auto [after_height, height_error] = std::from_chars(after_width + 1, end, height);
    whole = height_error == std::errc() && after_height == end;
  }
  if (!whole) throw Error(ErrorKind::wrong_usage, fmt::format("--size: '{}' is no size, expected WIDTHxHEIGHT", text));
}

}  // namespace wheatstone::cli
