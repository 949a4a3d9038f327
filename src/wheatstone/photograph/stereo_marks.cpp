#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "wheatstone/error.h"
#include "wheatstone/photograph/jpeg_segments_internal.h"
#include "wheatstone/photograph/stereo_marks_internal.h"
#include "wheatstone/pictures/jpeg.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view jps_signature = "_JPSJPS_";
constexpr std::uint8_t half_height_flag = 1, half_width_flag = 2, left_first_flag = 4;

[[noreturn]] void refuse_descriptor(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: its stereo descriptor (JPS) {}", path.string(), what));
}

}  // namespace

std::optional<JpsDescriptor> read_jps_descriptor(std::string_view bytes, const fs::path& path) {
  for (const JpegSegment& segment : jpeg_segments(bytes)) {
    if (segment.marker != app3 || !segment.data.starts_with(jps_signature)) continue;
    // A length, then from the highest byte down: separation, flags, layout, type.
    const std::string_view block = segment.data.substr(jps_signature.size());
    if (block.size() < 6) refuse_descriptor(path, "is cut short");
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(block[i]); };
    const std::uint8_t flags = byte(3), arrangement = byte(4), type = byte(5);
    JpsDescriptor descriptor;
    descriptor.stereo = type != 0;
    if (!descriptor.stereo) return descriptor;
    if (type != 1 || arrangement < 1 || arrangement > 4)
      refuse_descriptor(path,
                        fmt::format("has type {} and layout {}, expected type 1 and layout 1 to 4", type, arrangement));
    descriptor.arrangement = static_cast<JpsDescriptor::Arrangement>(arrangement);
    descriptor.half_height = (flags & half_height_flag) != 0;
    descriptor.half_width = (flags & half_width_flag) != 0;
    descriptor.left_first = (flags & left_first_flag) != 0;
    return descriptor;
  }
  return {};
}

std::string with_jps_descriptor(const std::string& jpeg, const JpsDescriptor& descriptor) {
  const int flags = (descriptor.half_height ? half_height_flag : 0) | (descriptor.half_width ? half_width_flag : 0) |
                    (descriptor.left_first ? left_first_flag : 0);
  std::string data(jps_signature);
  data += std::string("\0\4\0", 3);  // the descriptor's length; no separation
  data += static_cast<char>(flags);
  data += static_cast<char>(descriptor.arrangement);
  data += '\1';                    // stereoscopic
  data += std::string("\0\0", 2);  // no comment
  std::string marked = jpeg;
  marked.insert(end_of_first_segments(jpeg), jpeg_segment(app3, data));
  return marked;
}

std::optional<StereoChunk> read_stereo_chunk(std::string_view bytes) {
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) return {};
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12 || bytes.substr(at + 4, 4) == "IDAT") return {};
    if (bytes.substr(at + 4, 4) == "sTER" && length == 1) {
      const auto mode = static_cast<std::uint8_t>(bytes[at + 8]);
      if (mode > 1) return {};
      return StereoChunk{mode == 1};
    }
    at += length + 12;
  }
  return {};
}

}  // namespace wheatstone
