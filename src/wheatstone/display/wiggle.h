#pragma once

#include <filesystem>
#include <span>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Writes views as an endless animation that goes from the left-most to the right-most and back: depth for a screen
/// without any glasses. By the file's ending .gif (256 colours a frame) or .webp (lossless). Two or more views of one
/// size; `seconds` is for there and back. Appears only when it is whole. Throws Error: wrong_usage for another ending,
/// fewer views or different sizes, cannot_read_write.
void write_wiggle(const std::filesystem::path& path, std::span<const Image<Rgb8>> views, double seconds = 0.5);

}  // namespace wheatstone
