#include "disparity_argument.h"

#include <filesystem>

#include "number_arguments.h"
#include "wheatstone/pictures/disparity_file.h"

namespace wheatstone::cli {

Image<float> read_disparity_argument(const std::string& argument) {
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument)) return read_disparity(argument);
  // Stored values are divided by the scale.
  const auto scale = static_cast<float>(
      parse_number(argument.substr(0, colon) + ": the scale", argument.substr(colon + 1), {1e-9, 1e9}));
  return read_disparity(argument.substr(0, colon), scale);
}

}  // namespace wheatstone::cli
