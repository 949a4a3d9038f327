#include "film_argument.h"

#include <fmt/format.h>

#include "wheatstone/error.h"

namespace wheatstone::cli {

std::optional<StereoLayout> film_layout_option(const std::string& option, const std::string& name) {
  if (name.empty()) return {};
  const std::optional<StereoLayout> layout = find_stereo_layout(name);
  if (!layout)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: there is no layout '{}', expected one of {}", option, name, stereo_layout_names()));
  return layout;
}

}  // namespace wheatstone::cli
