#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// The bytes before a PNG's first chunk.
inline constexpr std::size_t png_signature_size = 8;

/// A part of a PNG; borrows the file's bytes.
struct PngChunk {
  std::string_view type, data;
  std::string_view whole;  ///< with its length and checksum
};

/// All chunks up to the last, IEND; nothing where the file breaks off or a checksum is wrong. PNG 1.2, sec. 3.2.
std::optional<std::vector<PngChunk>> png_chunks(std::string_view bytes);

/// The four bytes from `at` on, the highest first; they must be there.
std::uint32_t png_number(std::string_view bytes, std::size_t at);

/// Appends a number so, and a chunk with its length and checksum.
void append_png_number(std::size_t number, std::string& to);
void append_png_chunk(std::string_view type, std::string_view data, std::string& to);

}  // namespace wheatstone
