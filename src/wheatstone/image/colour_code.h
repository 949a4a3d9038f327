#pragma once

#include <optional>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A colour as it is written, "#3366ff" or "3366FF": sRGB, two hexadecimal digits a channel. Nothing where the text is
/// anything else.
std::optional<Rgb8> colour_of_code(std::string_view code);

}  // namespace wheatstone
