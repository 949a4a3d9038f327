#pragma once

#include <string>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// A picture of one channel, grey, or three, with bytes or words, as a PNG (PNG 1.2). Its colours are said to be sRGB
/// where the attribute oiio:ColorSpace says so. Made in parallel; the same bytes on any number of threads.
std::string encode_png(const StoredPicture& picture, const PixelRows& rows);

}  // namespace wheatstone
