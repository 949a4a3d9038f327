#pragma once

#include <filesystem>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Writes a picture in the format of its file name (.png, .jpg, .tif, .webp, .ppm, .bmp), under a temporary name that
/// becomes the real one when the file is whole. Throws Error{cannot_read_write}; then nothing is left behind.
void write_image(const std::filesystem::path& path, ImageView<const Rgb8> image);
void write_image(const std::filesystem::path& path, ImageView<const std::uint8_t> image);

}  // namespace wheatstone
