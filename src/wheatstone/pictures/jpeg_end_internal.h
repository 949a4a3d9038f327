#pragma once

#include <string_view>

namespace wheatstone {

/// False where the bytes are a JPEG whose picture data breaks off before its end marker. Decoders only warn then and
/// fill the rest with grey. True for everything that is not a JPEG.
bool jpeg_is_whole(std::string_view bytes);

}  // namespace wheatstone
