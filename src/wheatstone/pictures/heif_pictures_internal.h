#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// Whether the bytes begin as a HEIF, HEIC or AVIF file does.
bool is_heif(std::string_view bytes);

/// The ICC profile of a HEIF file's primary picture; empty where there is none.
std::string heif_profile(std::string_view bytes);

/// The EXIF data of a HEIF file's primary picture, from their TIFF header on; empty where there are none.
std::string heif_exif(std::string_view bytes);

}  // namespace wheatstone
