#pragma once

#include <filesystem>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads a photograph as 8-bit sRGB: grey becomes three equal channels, 16-bit and float are rounded, CMYK is
/// converted, alpha is composited over white, EXIF orientation is applied.
/// Throws Error{bad_input} where the file is missing, is no picture, or is truncated.
Image<Rgb8> read_image(const std::filesystem::path& path);

}  // namespace wheatstone
