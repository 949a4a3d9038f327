#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>

#include "wheatstone/files/deflate.h"
#include "wheatstone/marks/deflated.h"

namespace wheatstone {

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

std::optional<std::vector<std::uint8_t>> inflated(std::span<const std::uint8_t> bytes, std::size_t size) {
  constexpr std::size_t most_inflation = 1032;  // zlib cannot make more of a byte
  if (size > bytes.size() * most_inflation) return {};
  std::vector<std::uint8_t> result(size);
  auto made = static_cast<uLongf>(size);
  auto used = static_cast<uLong>(bytes.size());
  if (uncompress2(result.data(), &made, bytes.data(), &used) != Z_OK || made != size || used != bytes.size()) return {};
  return result;
}

}  // namespace wheatstone
