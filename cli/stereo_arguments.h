#pragma once

#include <string>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::cli {

/// Reads two photographs. Throws Error{bad_input} that names both where their sizes differ.
StereoPair read_pair(const std::string& left, const std::string& right);

}  // namespace wheatstone::cli
