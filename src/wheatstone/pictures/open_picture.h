#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// A reader and, where it does not read the file itself, the bytes that it reads.
struct OpenPicture {
  std::string bytes;
  std::string colour_profile;  ///< ICC, as it stands in the file; empty where there is none
  std::unique_ptr<PictureReader> reader;
};

/// A picture of a sensible size, opened: its header is read, its pixels are not. Alpha stays unassociated where the
/// file has it so. Throws Error as read_image.
OpenPicture open_picture(const std::filesystem::path& path);

/// The same of a JPEG in memory, as it stands among others in a file; `path` stands for it in messages. `least_side`
/// as of open_jpeg_bytes.
OpenPicture open_jpeg(std::string_view bytes, const std::filesystem::path& path,
                      int least_side = std::numeric_limits<int>::max());

/// The same of a PNG in memory, with the ICC profile that belongs to it.
OpenPicture open_png(std::string_view bytes, std::string_view colour_profile, const std::filesystem::path& path);

/// All bytes of what is to be a picture. Throws Error as read_image for what is missing, empty or no file.
std::string read_picture_bytes(const std::filesystem::path& path);

/// The longest file that is taken for a picture, in bytes.
constexpr std::size_t most_picture_bytes = std::numeric_limits<std::int32_t>::max();

/// Throws Error{bad_input} that gives the decoder's reason.
[[noreturn]] void refuse_damaged(const std::filesystem::path& path, std::string reason);

}  // namespace wheatstone
