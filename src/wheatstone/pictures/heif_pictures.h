#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Reads all pictures of a HEIC or AVIF file that stand on their own (no thumbnails, no depth or alpha), in the order
/// of the file, each as read_image. Throws Error{bad_input}.
std::vector<Image<Rgb8>> read_heif_pictures(const std::filesystem::path& path);

/// The version of the library that reads them, as "1.15.1".
std::string heif_version();

}  // namespace wheatstone
