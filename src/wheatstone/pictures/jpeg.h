#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

bool is_jpeg(std::string_view bytes);

/// A segment with its marker, 0xE1 for APP1, and its length. ITU-T T.81, sec. B.1.1.4. `data` has at most 65 533 bytes.
std::string jpeg_segment(std::uint8_t marker, std::string_view data);

/// False for a JPEG that ends before its pixels do: decoders fill the rest with grey and say nothing. True for
/// everything that is not JPEG. ITU-T T.81, annex B.
bool jpeg_is_whole(std::string_view bytes);

/// Reads a JPEG with libjpeg alone; CMYK becomes RGB. `bytes` outlive the reader. Its attributes are Orientation and
/// ICCProfile, where it has them.
/// With `least_side` it is decoded fast, as the smallest of an eighth, a quarter and a half of its size whose sides
/// have at least so many pixels; where none has, whole.
OpenedPicture open_jpeg_bytes(std::string_view bytes, int least_side = std::numeric_limits<int>::max());

/// A picture of bytes with one channel, grey, or three as a JPEG whose colours are kept at full resolution: halved
/// chroma would give an anaglyph ghosts. `quality` is 1..100. Sides have at most 65 500 pixels.
EncodedPicture encode_jpeg(const StoredPicture& picture, const PixelRows& rows, int quality);

}  // namespace wheatstone
