#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {

/// Reads all pictures of a HEIC or AVIF file that stand on their own (no thumbnails, no depth or alpha), in the order
/// of the file, each as read_in_profile. Throws Error{bad_input}.
std::vector<PictureInProfile> read_heif_pictures(const std::filesystem::path& path);

/// What the numbers of a HEIC file's depth image stand for (ISO/IEC 23008-2, sec. F.14.3.3).
enum class HeifDepthKind {
  inverse,  ///< larger is nearer: an inverse of the distance, or a disparity
  distance  ///< larger is farther: the distance itself, in any unit
};

struct HeifDepth {
  Image<float> depth;  ///< `inverse`: 0..1 of what its bits hold
  HeifDepthKind kind = HeifDepthKind::inverse;
};

/// The depth image that belongs to the main picture of a HEIC or AVIF file; none where there is none.
/// Throws Error{bad_input} where the file or its depth image is damaged.
std::optional<HeifDepth> read_heif_depth(const std::filesystem::path& path);

/// Whether the bytes begin as a HEIF, HEIC or AVIF file does.
bool is_heif(std::string_view bytes);

/// The ICC profile of a HEIF file's primary picture; empty where there is none.
std::string heif_profile(std::string_view bytes);

/// The EXIF data of a HEIF file's primary picture, from their TIFF header on; empty where there are none.
std::string heif_exif(std::string_view bytes);

/// The version of the library that reads them, as "1.15.1".
std::string heif_version();

}  // namespace wheatstone
