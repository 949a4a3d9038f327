#pragma once

#include <string>

#include "wheatstone/image/image.h"

namespace wheatstone::cli {

/// Reads "FILE" or "FILE:scale": disparity in pixels is the stored value divided by the scale. A file whose own name
/// has a colon is taken as it is. Throws Error as read_disparity.
Image<float> read_disparity_argument(const std::string& argument);

}  // namespace wheatstone::cli
