#include "disparity_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "number_arguments.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/disparity_file.h"

namespace wheatstone::cli {

namespace {

Image<float> read_known(const std::string& name, std::optional<float> scale) {
  Image<float> disparity = read_disparity(name, scale);
  if (std::ranges::none_of(disparity.pixels(), [](float value) { return std::isfinite(value); }))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: the disparity is unknown everywhere, expected at least one finite value", name));
  return disparity;
}

}  // namespace

Image<float> read_disparity_argument(const std::string& argument) {
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument)) return read_known(argument, {});
  // Stored values are divided by the scale.
  const auto scale = static_cast<float>(
      parse_number(argument.substr(0, colon) + ": the scale", argument.substr(colon + 1), {1e-9, 1e9}));
  return read_known(argument.substr(0, colon), scale);
}

}  // namespace wheatstone::cli
