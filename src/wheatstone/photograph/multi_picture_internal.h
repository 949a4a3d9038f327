#pragma once

// The bytes of CIPA DC-007 (Multi-Picture Format): several JPEGs in one file, with an index in the first.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// What a picture in a multi-picture file is for (DC-007, table 4): the low 24 bits of its attribute.
enum MultiPictureType : std::uint32_t {
  multi_picture_undefined = 0x000000,
  multi_picture_large_thumbnail = 0x010000,  ///< and what differs from it in the low 16 bits
  multi_picture_panorama = 0x020001,
  multi_picture_disparity = 0x020002,
  multi_picture_multi_angle = 0x020003,
  multi_picture_primary = 0x030000,
};

/// One JPEG in the file.
struct MultiPictureEntry {
  std::size_t begin = 0;  ///< in bytes from the start of the file
  std::size_t length = 0;
  std::uint32_t type = multi_picture_undefined;
  std::optional<std::uint32_t> number;  ///< MPIndividualNum: views are counted from the left; none where not told
};

/// The pictures that a JPEG's index lists, in the index's order; none where it has no index. Every entry lies within
/// the bytes and begins as a JPEG does. Throws Error{bad_input} that names `path` where the index is damaged.
std::vector<MultiPictureEntry> read_multi_picture_index(std::string_view bytes, const std::filesystem::path& path);

/// One file of JPEGs that show the same from viewpoints from left to right: type disparity, numbered from 1, the first
/// of them the representative one. `jpegs` have no index of their own and number at least two.
std::string join_multi_pictures(std::span<const std::string> jpegs);

}  // namespace wheatstone
