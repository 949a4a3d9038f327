#include <zlib.h>

#include <algorithm>
#include <cstdint>

#include "wheatstone/pictures/plain_png_internal.h"

namespace wheatstone {
namespace {

constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_frame_size = 12;  // length and type before the data, checksum behind it

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

bool is_needed(std::string_view type) {
  constexpr std::string_view needed[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND", "eXIf"};
  return std::find(std::begin(needed), std::end(needed), type) != std::end(needed);
}

}  // namespace

std::optional<std::string> plain_png(std::string_view bytes) {
  std::string plain(bytes.substr(0, signature_size));
  std::size_t at = signature_size;
  while (at + chunk_frame_size <= bytes.size()) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - chunk_frame_size) return {};
    const std::string_view chunk = bytes.substr(at, chunk_frame_size + length);
    const std::string_view type = chunk.substr(4, 4);
    const auto* checked = reinterpret_cast<const Bytef*>(type.data());
    if (crc32_z(0, checked, 4 + length) != number_at(chunk, 8 + length)) return {};
    if (is_needed(type)) plain += chunk;
    if (type == "IEND") return plain;
    at += chunk.size();
  }
  return {};
}

}  // namespace wheatstone
