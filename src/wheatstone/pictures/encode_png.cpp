#include "wheatstone/pictures/encoders_internal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/files/deflate.h"
#include "wheatstone/pictures/png_chunks.h"

namespace wheatstone {
namespace {

/// sRGB with absolute colours, and what stands for it where a reader does not know it (PNG 1.2, sec. 4.2.2).
void append_srgb(std::string& to) {
  append_png_chunk("sRGB", "\x03", to);
  std::string gamma, colours;
  append_png_number(45455, gamma);
  for (const std::size_t place : {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000})
    append_png_number(place, colours);
  append_png_chunk("gAMA", gamma, to);
  append_png_chunk("cHRM", colours, to);
}

/// The bytes of a row as a PNG has them: the higher byte of a word first.
std::span<const std::uint8_t> in_network_order(std::span<const std::uint8_t> row, NumberKind kind,
                                               std::vector<std::uint8_t>& room) {
  if (kind != words_kind || std::endian::native == std::endian::big) return row;
  room.resize(row.size());
  for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
    room[i] = row[i + 1];
    room[i + 1] = row[i];
  }
  return room;
}

/// What Paeth's filter leaves of `count` bytes (PNG 1.2, sec. 6.6), each with those of the pixel before, above and
/// above that one. Comparing all filters nearly always chooses it.
void filter(const std::uint8_t* __restrict own, const std::uint8_t* __restrict before,
            const std::uint8_t* __restrict above, const std::uint8_t* __restrict above_before, std::size_t count,
            std::uint8_t* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::int16_t left = before[i], over = above[i], corner = above_before[i];
    const auto across = static_cast<std::int16_t>(over - corner), down = static_cast<std::int16_t>(left - corner);
    const auto both = static_cast<std::int16_t>(across + down);
    const auto to_left = static_cast<std::int16_t>(across < 0 ? -across : across);
    const auto to_over = static_cast<std::int16_t>(down < 0 ? -down : down);
    const auto to_corner = static_cast<std::int16_t>(both < 0 ? -both : both);
    const std::int16_t next = to_over <= to_corner ? over : corner;
    const std::int16_t predicted = to_left <= std::min(to_over, to_corner) ? left : next;
    to[i] = static_cast<std::uint8_t>(own[i] - predicted);
  }
}

/// Appends a row, filtered. The pixels before the first and above the first row are black.
void append_filtered(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above, std::size_t pixel_bytes,
                     std::vector<std::uint8_t>& to) {
  constexpr std::uint8_t paeth = 4;
  to.push_back(paeth);
  const std::size_t begin = to.size();
  to.resize(begin + row.size());
  std::uint8_t* const filtered = to.data() + begin;
  constexpr std::array<std::uint8_t, 8> black{};
  filter(row.data(), black.data(), above.data(), black.data(), pixel_bytes, filtered);
  filter(row.data() + pixel_bytes, row.data(), above.data() + pixel_bytes, above.data(), row.size() - pixel_bytes,
         filtered + pixel_bytes);
}

}  // namespace

std::string encode_png(const StoredPicture& picture, const PixelRows& rows) {
  const std::size_t pixel_bytes = static_cast<std::size_t>(picture.channels * picture.kind.bits / 8);
  const std::size_t row_bytes = static_cast<std::size_t>(picture.width) * pixel_bytes;
  const auto row = [&](int y) {
    return std::span(static_cast<const std::uint8_t*>(rows.first) + y * rows.row_bytes, row_bytes);
  };
  constexpr std::size_t part_bytes = std::size_t{1} << 20;
  const int part_rows = static_cast<int>(std::max<std::size_t>(part_bytes / (row_bytes + 1), 1));
  const int parts = (picture.height + part_rows - 1) / part_rows;
  const std::string deflated =
      zlib_stream(static_cast<std::size_t>(parts), [&](std::size_t part, std::vector<std::uint8_t>& room) {
        const int first = static_cast<int>(part) * part_rows, end = std::min(first + part_rows, picture.height);
        room.reserve(static_cast<std::size_t>(end - first) * (row_bytes + 1));
        std::vector<std::uint8_t> swapped, swapped_above;
        const std::vector<std::uint8_t> black(first == 0 ? row_bytes : 0);
        for (int y = first; y < end; ++y) {
          const std::span<const std::uint8_t> above =
              y > 0 ? in_network_order(row(y - 1), picture.kind, swapped_above) : black;
          append_filtered(in_network_order(row(y), picture.kind, swapped), above, pixel_bytes, room);
        }
        return std::span<const std::uint8_t>(room);
      });

  std::string png("\x89PNG\r\n\x1a\n", 8);
  std::string header;
  append_png_number(static_cast<std::size_t>(picture.width), header);
  append_png_number(static_cast<std::size_t>(picture.height), header);
  constexpr char grey = 0, colour = 2;
  header += {static_cast<char>(picture.kind.bits), picture.channels == 1 ? grey : colour, 0, 0, 0};
  append_png_chunk("IHDR", header, png);
  if (picture.value_of<std::string>("oiio:ColorSpace", {}) == "sRGB") append_srgb(png);
  for (const auto& [name, attribute] : picture.attributes) {
    const auto* const text = std::get_if<std::string>(&attribute);
    if (text != nullptr && name.starts_with(png_text))
      append_png_chunk("tEXt", name.substr(png_text.size()) + '\0' + *text, png);
  }
  constexpr std::size_t longest_chunk = std::size_t{1} << 30, for_frames_of_chunks = 1024;
  png.reserve(png.size() + deflated.size() + for_frames_of_chunks);
  for (std::size_t at = 0; at < deflated.size(); at += longest_chunk)
    append_png_chunk("IDAT", std::string_view(deflated).substr(at, longest_chunk), png);
  append_png_chunk("IEND", {}, png);
  return png;
}

}  // namespace wheatstone
