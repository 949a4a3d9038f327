#pragma once

#include <filesystem>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads a grey Portable Float Map ("Pf"), of either byte order; row 0 of the result is the top one, which the format
/// stores last. `name` stands for the file in messages. Throws Error{bad_input}.
Image<float> decode_pfm(std::string_view bytes, std::string_view name);

/// Writes a picture as a grey Portable Float Map of this machine's byte order. Throws Error{cannot_read_write}.
void write_pfm(const std::filesystem::path& path, ImageView<const float> image);

}  // namespace wheatstone
