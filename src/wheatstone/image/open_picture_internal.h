#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wheatstone {

/// A decoder and, where it does not read the file itself, the bytes that it reads.
struct OpenPicture {
  std::string bytes;
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> decoder;
};

/// A picture of a sensible size, opened: its header is read, its pixels are not. Alpha stays unassociated where the
/// file has it so. Throws Error as read_image.
OpenPicture open_picture(const std::filesystem::path& path);

/// Throws Error{bad_input} that gives the decoder's reason.
[[noreturn]] void refuse_damaged(const std::filesystem::path& path, std::string reason);

}  // namespace wheatstone
