#pragma once

#include <filesystem>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads a picture of depth: the numbers as they are stored, whatever they stand for; NaN where they are not finite.
/// PNG and other pictures of 8 or 16 bits (grey, or colours that are equal), PFM of either byte order, EXR.
/// Throws Error{bad_input} where the file is missing, damaged, in colour, or holds no finite number.
Image<float> read_depth(const std::filesystem::path& path);

/// The same of a PNG or JPEG in memory, brought to 0..1 of what its bits hold; `path` stands for it in messages.
Image<float> decode_depth(std::string_view bytes, const std::filesystem::path& path);

}  // namespace wheatstone
