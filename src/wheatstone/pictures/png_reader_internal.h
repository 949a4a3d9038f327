#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// The PNG with only the chunks that make its pixels and turn them upright; nothing where the file breaks off or a
/// checksum is wrong. libpng would write of damage, and of harmless oddities in colour profiles and comments, on
/// standard error, where a program's own one line belongs. PNG 1.2, sec. 3.2 and 4.
std::optional<std::string> plain_png(std::string_view bytes);

bool is_png(std::string_view bytes);

/// Reads a PNG with libpng alone: palettes and less than 8 bits become bytes, transparent colours an alpha channel.
/// `bytes` outlive the reader and are whole (plain_png). Its only attribute is Orientation, from a chunk eXIf.
OpenedPicture open_png_bytes(std::string_view bytes, StoredAlpha alpha);

}  // namespace wheatstone
