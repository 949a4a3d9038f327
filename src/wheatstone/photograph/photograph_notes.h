#pragma once

#include <filesystem>

#include "wheatstone/pictures/picture_notes.h"

namespace wheatstone {

/// What the file of a photograph says of it that goes into pictures that are made of it: its title (XMP's dc:title,
/// EXIF's, or a PNG's text), when it was taken, and its EXIF data. These lose what belongs to the file alone
/// (orientation, size, thumbnail, the maker's notes) and, unless `keep_location`, where it was taken. Only the title
/// and the time of formats other than JPEG, PNG and HEIC. Notes that are damaged, and files that cannot be read, give
/// none.
PictureNotes read_photograph_notes(const std::filesystem::path& path, bool keep_location = false);

}  // namespace wheatstone
