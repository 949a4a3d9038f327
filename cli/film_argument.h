#pragma once

#include <optional>
#include <string>

#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone::cli {

/// The layout of a --layout option; nothing where it is empty. Throws Error{wrong_usage} that lists the names.
std::optional<StereoLayout> film_layout_option(const std::string& option, const std::string& name);

}  // namespace wheatstone::cli
