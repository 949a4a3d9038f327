#pragma once

#include <string>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

struct EncodedPng {
  std::string bytes;
  std::string complaint;  ///< why there are no bytes
};

/// A picture of one channel, grey, or three, with bytes or words, as a PNG. Its colours are said to be sRGB where the
/// attribute oiio:ColorSpace says so.
EncodedPng encode_png(const StoredPicture& picture, const PixelRows& rows);

}  // namespace wheatstone
