#pragma once

#include <filesystem>
#include <string>

namespace wheatstone {

/// What a picture file says of itself, before anything is converted.
struct ImageDescription {
  std::string format;  ///< "png", "jpeg", "tiff" and so on
  int width = 0;       ///< as stored, before its orientation is applied
  int height = 0;
  int channels = 0;
  bool has_alpha = false;
  int bits = 8;  ///< of each channel
  bool is_float = false;
  int orientation = 1;  ///< EXIF: 1 is upright
};

/// Reads a picture's header. Throws Error as read_image; damage behind the header may go unseen.
ImageDescription describe_image(const std::filesystem::path& path);

}  // namespace wheatstone
