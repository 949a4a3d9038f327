#include "wheatstone/files/deflate.h"

#include <isa-l/igzip_lib.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <new>

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
    made[i] = {deflated_part(bytes, i + 1 == made.size()), adler32_z(1, bytes.data(), bytes.size()), bytes.size()};
  });
  std::string stream{'\x78', '\x5e'};  // a window of 32 KiB; fast
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

}  // namespace wheatstone
