#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "wheatstone/pictures/animated_png_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_frame_size = 12;  // length and type before the data, checksum behind it

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

void put_number(std::uint64_t number, std::string& bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
}

struct Chunk {
  std::string_view type, data;
};

/// All up to the last; nothing where the file breaks off or a checksum is wrong.
std::optional<std::vector<Chunk>> chunks_of(std::string_view bytes) {
  std::vector<Chunk> chunks;
  for (std::size_t at = signature_size; at + chunk_frame_size <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - chunk_frame_size) return {};
    const std::string_view checked = bytes.substr(at + 4, 4 + length);
    if (crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()) != number_at(bytes, at + 8 + length))
      return {};
    chunks.push_back({checked.substr(0, 4), checked.substr(4)});
    if (chunks.back().type == "IEND") return chunks;
    at += chunk_frame_size + length;
  }
  return {};
}

void put_chunk(std::string_view type, std::string_view data, std::string& bytes) {
  put_number(data.size(), bytes);
  const std::size_t checked = bytes.size();
  bytes.append(type).append(data);
  put_number(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + checked), bytes.size() - checked), bytes);
}

/// A frame's control chunk, fcTL: its size and place, and whether it is blended with what was there.
bool replaces_all(std::string_view control, std::string_view header) {
  constexpr std::size_t control_size = 26, place_at = 12, blend_at = 25, colour_type_at = 9;
  constexpr int has_alpha = 4;
  if (control.size() != control_size || header.size() <= colour_type_at) return false;
  const bool is_blended = control[blend_at] != 0 && (header[colour_type_at] & has_alpha) != 0;
  const bool at_corner = number_at(control, place_at) == 0 && number_at(control, place_at + 4) == 0;
  return at_corner && !is_blended && control.substr(4, 8) == header.substr(0, 8);
}

}  // namespace

bool is_animated_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1a\n") && bytes.find("acTL") < bytes.find("IDAT");
}

std::optional<std::vector<std::string>> frames_of_png(std::string_view bytes, int most_frames) {
  const auto chunks = chunks_of(bytes);
  if (!chunks || chunks->front().type != "IHDR") return {};
  const std::string_view header = chunks->front().data;
  std::string begin(bytes.substr(0, signature_size));
  put_chunk("IHDR", header, begin);
  for (const Chunk& chunk : *chunks)
    if (chunk.type == "PLTE" || chunk.type == "tRNS") put_chunk(chunk.type, chunk.data, begin);

  constexpr std::size_t number_size = 4;  // of a frame's data, before them
  std::vector<std::string> frames;
  for (const Chunk& chunk : *chunks) {
    if (chunk.type == "fcTL") {
      if (static_cast<int>(frames.size()) == most_frames) break;
      if (!replaces_all(chunk.data, header)) return {};
      frames.push_back(begin);
    }
    // What stands before the first frame is shown only where frames are not.
    if (frames.empty()) continue;
    if (chunk.type == "IDAT") put_chunk("IDAT", chunk.data, frames.back());
    if (chunk.type == "fdAT")
      put_chunk("IDAT", chunk.data.substr(std::min(number_size, chunk.data.size())), frames.back());
  }
  for (std::string& frame : frames) put_chunk("IEND", {}, frame);
  return frames;
}

}  // namespace wheatstone
