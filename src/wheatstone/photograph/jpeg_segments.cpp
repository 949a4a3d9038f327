#include "wheatstone/photograph/jpeg_segments_internal.h"

namespace wheatstone {
namespace {

constexpr std::uint8_t start_of_image = 0xD8, end_of_image = 0xD9, start_of_scan = 0xDA;

std::uint8_t byte(std::string_view bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

std::size_t short_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::size_t>(byte(bytes, at)) << 8 | byte(bytes, at + 1);
}

/// SOF0 to SOF15, but for the three markers among them that begin something else.
bool is_frame_header(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

}  // namespace

std::size_t big_endian(std::string_view bytes, std::size_t at) {
  return short_at(bytes, at) << 16 | short_at(bytes, at + 2);
}

std::vector<JpegSegment> jpeg_segments(std::string_view bytes) {
  std::vector<JpegSegment> segments;
  if (bytes.size() < 2 || byte(bytes, 0) != 0xFF || byte(bytes, 1) != start_of_image) return segments;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byte(bytes, at) == 0xFF) {
    const std::uint8_t marker = byte(bytes, at + 1);
    if (marker == 0xFF) {  // fill bytes may stand before any marker
      ++at;
      continue;
    }
    if (marker == start_of_scan || marker == end_of_image) break;
    const std::size_t length = short_at(bytes, at + 2);
    if (length < 2 || length > bytes.size() - at - 2) break;
    segments.push_back({marker, at, bytes.substr(at + 4, length - 2)});
    at += 2 + length;
  }
  return segments;
}

std::size_t end_of_first_segments(std::string_view jpeg) {
  std::size_t end = 2;
  for (const JpegSegment& segment : jpeg_segments(jpeg)) {
    if (segment.marker != app0 && segment.marker != app1) break;
    end = segment.begin + 4 + segment.data.size();
  }
  return end;
}

std::optional<JpegSize> jpeg_size(std::string_view bytes) {
  for (const JpegSegment& segment : jpeg_segments(bytes))
    if (is_frame_header(segment.marker) && segment.data.size() >= 5)
      return JpegSize{static_cast<int>(short_at(segment.data, 3)), static_cast<int>(short_at(segment.data, 1))};
  return {};
}

}  // namespace wheatstone
