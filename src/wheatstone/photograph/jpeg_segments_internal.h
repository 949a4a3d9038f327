#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace wheatstone {

inline constexpr std::uint8_t app0 = 0xE0, app1 = 0xE1, app2 = 0xE2, app3 = 0xE3;  ///< markers of segments

/// The four bytes at `at`, the highest first.
std::size_t big_endian(std::string_view bytes, std::size_t at);

/// One marker segment of a JPEG: what stands behind its marker and length.
struct JpegSegment {
  std::uint8_t marker = 0;  ///< 0xE2 is APP2
  std::size_t begin = 0;    ///< of the segment's marker, in the bytes that were asked
  std::string_view data;
};

/// The segments of the JPEG at the start of the bytes, up to its picture data; none where it is no JPEG, and those
/// before the damage where a length points beyond the bytes. ITU-T T.81, sec. B.1.
std::vector<JpegSegment> jpeg_segments(std::string_view bytes);

/// The end of the APP0 and APP1 segments at the start of a JPEG. JFIF and Exif must come first; others stand behind.
std::size_t end_of_first_segments(std::string_view jpeg);

struct JpegSize {
  int width = 0;
  int height = 0;
  friend bool operator==(const JpegSize&, const JpegSize&) = default;
};

/// The size that a JPEG's frame header tells; none where it has no such header before its picture data.
std::optional<JpegSize> jpeg_size(std::string_view bytes);

}  // namespace wheatstone
