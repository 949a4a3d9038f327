#include "wheatstone/pictures/png_chunks.h"

#include "wheatstone/files/deflate.h"

namespace wheatstone {

std::uint32_t png_number(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

std::optional<std::vector<PngChunk>> png_chunks(std::string_view bytes) {
  constexpr std::size_t frame_size = 12;  // length and type before the data, checksum behind it
  std::vector<PngChunk> chunks;
  for (std::size_t at = png_signature_size; at + frame_size <= bytes.size();) {
    const std::size_t length = png_number(bytes, at);
    if (length > bytes.size() - at - frame_size) return {};
    const std::string_view whole = bytes.substr(at, frame_size + length), checked = whole.substr(4, 4 + length);
    if (crc32_of(checked) != png_number(whole, 8 + length)) return {};
    chunks.push_back({checked.substr(0, 4), checked.substr(4), whole});
    if (chunks.back().type == "IEND") return chunks;
    at += whole.size();
  }
  return {};
}

void append_png_number(std::size_t number, std::string& to) {
  for (const int shift : {24, 16, 8, 0}) to += static_cast<char>(number >> shift);
}

void append_png_chunk(std::string_view type, std::string_view data, std::string& to) {
  append_png_number(data.size(), to);
  const std::size_t checked = to.size();
  to.append(type).append(data);
  append_png_number(crc32_of(std::string_view(to).substr(checked)), to);
}

}  // namespace wheatstone
