#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/photograph/jpeg_segments_internal.h"
#include "wheatstone/photograph/xmp_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view packet_signature{"http://ns.adobe.com/xap/1.0/\0", 29};
constexpr std::string_view extension_signature{"http://ns.adobe.com/xmp/extension/\0", 35};
constexpr std::size_t guid_size = 32, number_size = 4;

[[noreturn]] void refuse_extension(const fs::path& path, std::string_view what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: its extended XMP is damaged: {}", path.string(), what));
}

/// Puts the chunks of this name together. Each tells the length of the whole and its own place in it.
std::string read_extended(const std::vector<JpegSegment>& segments, std::string_view guid, const fs::path& path) {
  std::string whole;
  std::size_t filled = 0;
  std::vector<bool> known;
  for (const JpegSegment& segment : segments) {
    if (segment.marker != app1 || !segment.data.starts_with(extension_signature)) continue;
    std::string_view chunk = segment.data.substr(extension_signature.size());
    if (chunk.size() < guid_size + 2 * number_size) refuse_extension(path, "a chunk is cut short");
    if (chunk.substr(0, guid_size) != guid) continue;
    const std::size_t length = big_endian(chunk, guid_size), at = big_endian(chunk, guid_size + number_size);
    chunk.remove_prefix(guid_size + 2 * number_size);
    // No chunk is longer than a segment: who announces more than all segments hold is not believed.
    constexpr std::size_t longest_segment = 65533;
    if (length > segments.size() * longest_segment) refuse_extension(path, "it is longer than the file");
    if (whole.empty()) {
      whole.resize(length);
      known.resize(length);
    }
    if (length != whole.size()) refuse_extension(path, "its chunks differ about its length");
    if (at > length || chunk.size() > length - at) refuse_extension(path, "a chunk lies beyond its end");
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      if (known[at + i]) refuse_extension(path, "two chunks overlap");
      known[at + i] = true;
    }
    whole.replace(at, chunk.size(), chunk);
    filled += chunk.size();
  }
  if (filled != whole.size() || whole.empty()) refuse_extension(path, "a chunk is missing");
  return whole;
}

bool is_space(char letter) { return std::isspace(static_cast<unsigned char>(letter)) != 0; }

}  // namespace

Xmp read_xmp(std::string_view jpeg, const fs::path& path) {
  const std::vector<JpegSegment> segments = jpeg_segments(jpeg);
  Xmp xmp;
  for (const JpegSegment& segment : segments)
    if (segment.marker == app1 && segment.data.starts_with(packet_signature) && xmp.packet.empty())
      xmp.packet = segment.data.substr(packet_signature.size());
  if (const auto guid = xmp_property(xmp.packet, "xmpNote:HasExtendedXMP"); guid && guid->size() == guid_size)
    xmp.extended = read_extended(segments, *guid, path);
  return xmp;
}

std::optional<std::string_view> xmp_property(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const char before = at > 0 ? text[at - 1] : '\0';
    std::size_t next = at + name.size();
    if (before == '<' && next < text.size() && text[next] == '>') {
      const std::size_t end = text.find('<', next);
      if (end == text.npos) return {};
      return text.substr(next + 1, end - next - 1);
    }
    if (!is_space(before)) continue;
    while (next < text.size() && is_space(text[next])) ++next;
    if (next >= text.size() || text[next] != '=') continue;
    do ++next;
    while (next < text.size() && is_space(text[next]));
    if (next >= text.size() || (text[next] != '"' && text[next] != '\'')) continue;
    const std::size_t end = text.find(text[next], next + 1);
    if (end == text.npos) return {};
    return text.substr(next + 1, end - next - 1);
  }
  return {};
}

std::optional<std::string_view> xmp_property(const Xmp& xmp, std::string_view name) {
  const auto found = xmp_property(xmp.packet, name);
  return found ? found : xmp_property(xmp.extended, name);
}

std::optional<std::string> decode_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_space(text[i])) continue;
    if (text[i] == '=') break;
    if (text[i] == '&') {
      i = text.find(';', i);
      if (i == text.npos) return {};
      continue;
    }
    const std::size_t digit = digits.find(text[i]);
    if (digit == digits.npos) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xFF);
  }
  return bytes;
}

}  // namespace wheatstone
