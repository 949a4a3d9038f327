#include "wheatstone/files/deflate.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <string>

namespace wheatstone {
namespace {

/// A part of a deflate stream (RFC 1951) that ends at a byte.
std::string deflated_part(std::span<const std::uint8_t> bytes, bool is_last) {
  constexpr std::uint32_t level = 2;
  thread_local std::vector<std::uint8_t> tables(ISAL_DEF_LVL2_DEFAULT);
  isal_zstream stream;
  isal_deflate_init(&stream);
  stream.level = level;
  stream.level_buf = tables.data();
  stream.level_buf_size = static_cast<std::uint32_t>(tables.size());
  stream.flush = is_last ? NO_FLUSH : FULL_FLUSH;
  stream.end_of_stream = is_last ? 1 : 0;
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());  // the library only reads it
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  std::string deflated;
  std::size_t step = bytes.size() / 2 + 512;
  do {
    const std::size_t written = deflated.size();
    deflated.resize(written + step);
    stream.next_out = reinterpret_cast<std::uint8_t*>(deflated.data()) + written;
    stream.avail_out = static_cast<std::uint32_t>(step);
    if (isal_deflate(&stream) != COMP_OK) throw std::bad_alloc();
    deflated.resize(written + step - stream.avail_out);
  } while (stream.avail_out == 0);
  return deflated;
}

}  // namespace

std::string zlib_stream(std::size_t parts, const PartOfBytes& part_of) {
  struct Part {
    std::string deflated;
    uLong checksum = 0, size = 0;
  };
  std::vector<Part> made(std::max<std::size_t>(parts, 1));
  tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) {
    thread_local std::vector<std::uint8_t> room;
    room.clear();
    const std::span<const std::uint8_t> bytes = parts > 0 ? part_of(i, room) : std::span<const std::uint8_t>();
    made[i] = {deflated_part(bytes, i + 1 == made.size()), isal_adler32(1, bytes.data(), bytes.size()), bytes.size()};
  });
  std::string stream{'\x78', '\x5e'};  // a window of 32 KiB; fast
  std::size_t stream_bytes = stream.size();
  for (const Part& part : made) stream_bytes += part.deflated.size();
  constexpr std::size_t checksum_bytes = 4;
  stream.reserve(stream_bytes + checksum_bytes);
  uLong checksum = 1;
  for (const Part& part : made) {
    stream += part.deflated;
    checksum = adler32_combine(checksum, part.checksum, static_cast<z_off_t>(part.size));
  }
  for (const int shift : {24, 16, 8, 0}) stream += static_cast<char>(checksum >> shift);
  return stream;
}

std::string zlib_stream(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t part_size = std::size_t{1} << 20;
  return zlib_stream((bytes.size() + part_size - 1) / part_size, [&](std::size_t part, std::vector<std::uint8_t>&) {
    return bytes.subspan(part * part_size, std::min(part_size, bytes.size() - part * part_size));
  });
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  const std::string stream = zlib_stream(bytes);
  return {stream.begin(), stream.end()};
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes, int level) {
  z_stream stream{};
  if (deflateInit(&stream, level) != Z_OK) throw std::bad_alloc();
  // What zlib may need at most, compressBound, is more than the bytes themselves.
  std::vector<std::uint8_t> result;
  std::size_t read = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    constexpr std::size_t step = std::size_t{1} << 18;
    const std::size_t written = result.size();
    result.resize(written + step);
    if (stream.avail_in == 0) {
      const std::size_t part = std::min<std::size_t>(bytes.size() - read, std::numeric_limits<uInt>::max());
      stream.next_in = const_cast<Bytef*>(bytes.data() + read);  // zlib only reads it
      stream.avail_in = static_cast<uInt>(part);
      read += part;
    }
    stream.next_out = result.data() + written;
    stream.avail_out = static_cast<uInt>(step);
    state = deflate(&stream, read == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    result.resize(written + step - stream.avail_out);
  }
  deflateEnd(&stream);
  return result;
}

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) { return crc32_gzip_refl(0, bytes.data(), bytes.size()); }
std::uint32_t crc32_of(std::string_view bytes) {
  return crc32_gzip_refl(0, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::optional<std::vector<std::uint8_t>> inflated(std::span<const std::uint8_t> bytes, std::size_t size) {
  constexpr std::size_t most_inflation = 1032;  // deflate cannot make more of a byte
  if (size > bytes.size() * most_inflation) return {};
  std::vector<std::uint8_t> result(size);
  std::span<const std::uint8_t> to_read = bytes;
  std::span<std::uint8_t> to_write = result;
  const auto state = std::make_unique<inflate_state>();
  isal_inflate_init(state.get());
  state->crc_flag = ISAL_ZLIB;
  do {
    constexpr std::size_t step = std::size_t{1} << 30;
    const std::size_t given = std::min(to_read.size(), step), room = std::min(to_write.size(), step);
    state->next_in = const_cast<std::uint8_t*>(to_read.data());  // the library only reads it
    state->avail_in = static_cast<std::uint32_t>(given);
    state->next_out = to_write.data();
    state->avail_out = static_cast<std::uint32_t>(room);
    if (isal_inflate(state.get()) != ISAL_DECOMP_OK) return {};
    const std::size_t used = given - state->avail_in, made = room - state->avail_out;
    if (used == 0 && made == 0) return {};
    to_read = to_read.subspan(used);
    to_write = to_write.subspan(made);
  } while (state->block_state != ISAL_BLOCK_FINISH);
  // The library reads ahead. A whole byte that it did not use lies behind the stream.
  constexpr int bits_a_byte = 8;
  if (!to_read.empty() || state->read_in_length >= bits_a_byte || !to_write.empty()) return {};
  return result;
}

}  // namespace wheatstone
