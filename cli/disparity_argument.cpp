#include "disparity_argument.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>

#include "wheatstone/error.h"
#include "wheatstone/pictures/disparity_file.h"

namespace wheatstone::cli {

Image<float> read_disparity_argument(const std::string& argument) {
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument)) return read_disparity(argument);
  const char* begin = argument.data() + colon + 1;
  const char* end = argument.data() + argument.size();
  float scale = 0;
  const auto [stop, error] = std::from_chars(begin, end, scale);
  if (error != std::errc{} || stop != end)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: the scale is '{}', expected FILE:NUMBER", argument, std::string(begin, end)));
  return read_disparity(argument.substr(0, colon), scale);
}

}  // namespace wheatstone::cli
