#include "wheatstone/pictures/embedded_profile_internal.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "wheatstone/pictures/heif_pictures.h"

namespace wheatstone {
namespace {

// The largest printer profiles have a few MB.
constexpr std::size_t most_profile_bytes = std::size_t{16} << 20;

std::size_t big_endian(std::string_view bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

std::size_t little_endian(std::string_view bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return number;
}

/// What a zlib stream holds; empty where it is damaged or longer than any profile.
std::string inflated(std::string_view packed) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string plain;
  int state = Z_OK;
  while (state == Z_OK && plain.size() < most_profile_bytes) {
    constexpr std::size_t step = 1 << 16;
    const std::size_t before = plain.size();
    plain.resize(before + step);
    stream.next_out = reinterpret_cast<Bytef*>(plain.data() + before);
    stream.avail_out = step;
    state = inflate(&stream, Z_NO_FLUSH);
    plain.resize(plain.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END ? plain : std::string();
}

/// PNG 1.2, sec. 4.2.2.4: a name, a zero, the method (0), the packed profile.
std::string png_profile(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return {};
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "IDAT") return {};
    if (type == "iCCP") {
      const std::string_view chunk = bytes.substr(at + 8, length);
      const std::size_t end_of_name = chunk.find('\0');
      if (end_of_name == std::string_view::npos || chunk.size() < end_of_name + 2) return {};
      return inflated(chunk.substr(end_of_name + 2));
    }
    at += length + 12;
  }
  return {};
}

/// WebP container specification: chunks of a name, a little-endian length and data padded to an even length.
std::string webp_profile(std::string_view bytes) {
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = little_endian(bytes, at + 4);
    if (length > bytes.size() - at - 8) return {};
    if (bytes.substr(at, 4) == "ICCP") return std::string(bytes.substr(at + 8, length));
    at += 8 + length + length % 2;
  }
  return {};
}

}  // namespace

std::string embedded_profile(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return png_profile(bytes);
  if (bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP") return webp_profile(bytes);
  if (is_heif(bytes)) return heif_profile(bytes);
  return {};
}

}  // namespace wheatstone
