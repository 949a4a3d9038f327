#pragma once

#include <string_view>

namespace wheatstone {

bool is_jpeg(std::string_view bytes);

/// False where the bytes are a JPEG whose picture data breaks off before its end marker. Decoders only warn then and
/// fill the rest with grey. True for everything that is not a JPEG.
bool jpeg_is_whole(std::string_view bytes);

}  // namespace wheatstone
