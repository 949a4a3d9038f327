#pragma once

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// What the module with OpenImageIO does: the functions of picture_file.h for all formats but PNG and JPEG. It is apart
/// because the libraries behind OpenImageIO take five times as long to load as all others, and most runs need none of
/// them.
struct PictureModule {
  OpenedPicture (*open_file)(const std::filesystem::path& path, StoredAlpha alpha);
  /// To `bytes`, or where there are none to the file; none where there is no such format.
  std::unique_ptr<PictureWriter> (*writer)(const std::string& ending, const std::filesystem::path& path,
                                           std::vector<unsigned char>* bytes);
};

/// The module's function that gives the others.
using GivePictureModule = const PictureModule*();
inline constexpr auto picture_module_name = "wheatstone_openimageio";
inline constexpr std::size_t picture_module_bytes = std::size_t{384} << 20;  // more than 200 libraries, and threads
inline constexpr auto give_picture_module_name = "wheatstone_picture_module";

}  // namespace wheatstone
