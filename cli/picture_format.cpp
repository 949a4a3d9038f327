#include "picture_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>

#include "typed_options.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {

CLI::Option* add_picture_format(CLI::App& command, std::string& format, const std::string& help) {
  static constexpr std::array<std::string_view, 4> formats{"png", "jpg", "tif", "webp"};
  return add_name(command, "--format", format, formats, help);
}

void check_picture_ending(const std::string& option, const std::string& output) {
  if (!is_picture_name(output))
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected a name that ends in {}", option, output,
                                                    fmt::join(picture_endings(), ", ")));
}

}  // namespace wheatstone::cli
