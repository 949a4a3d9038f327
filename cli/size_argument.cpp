#include "size_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

#include "numbers_argument.h"
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

void take_view_size(const std::string& text, int& width, int& height) {
  constexpr float most_pixels = 16384;
  const std::vector<float> size = parse_numbers("--size", text, 'x', 2);
  if (!(size[0] >= 1 && size[1] >= 1 && size[0] <= most_pixels && size[1] <= most_pixels))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--size: is '{}', expected 1x1 to {}x{}", text, most_pixels, most_pixels));
  width = static_cast<int>(size[0]);
  height = static_cast<int>(size[1]);
}

}  // namespace wheatstone::cli
