#pragma once

#include <filesystem>
#include <memory>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// Reads the first picture of a TIFF that does not tell its bits a sample, which then has one (TIFF 6.0, sec. 8):
/// OpenImageIO 2.4 takes eight. `picture` is what it says of the file otherwise. None where the file tells its bits.
/// Throws Error{bad_input} where the pixels cannot be read.
std::unique_ptr<PictureReader> bilevel_tiff_reader(const std::filesystem::path& path, StoredPicture picture);

}  // namespace wheatstone
