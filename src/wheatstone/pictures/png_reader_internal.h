#pragma once

#include <string_view>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

bool is_png(std::string_view bytes);

/// Reads a PNG with libpng alone: palettes and less than 8 bits become bytes, transparent colours an alpha channel.
/// `bytes` outlive the reader and are whole (plain_png). Its only attribute is Orientation, from a chunk eXIf.
OpenedPicture open_png_bytes(std::string_view bytes, StoredAlpha alpha);

}  // namespace wheatstone
