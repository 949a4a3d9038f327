#include <zlib.h>

#include "wheatstone/marks/deflated_internal.h"

namespace wheatstone {

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  constexpr int level = 4;  // higher ones take twice the time for a tenth of the size
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> result(size);
  compress2(result.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level);
  result.resize(size);
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
