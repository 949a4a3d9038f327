#include "wheatstone/files/deflate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <zlib.h>

#include "wheatstone/random.h"

namespace wheatstone::deflate_test {

std::vector<std::uint8_t> bytes_of(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(hash_keys({i / 7}) % (i % 5 == 0 ? 200 : 9));
  return bytes;
}

std::vector<std::uint8_t> inflated(const std::string& stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size + 1);
  auto made = static_cast<uLongf>(bytes.size());
  EXPECT_EQ(uncompress(bytes.data(), &made, reinterpret_cast<const Bytef*>(stream.data()), stream.size()), Z_OK);
  bytes.resize(made);
  return bytes;
}

TEST(ZlibStream, IsReadByZlib) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, std::size_t{3'500'001}}) {
    const std::vector<std::uint8_t> bytes = bytes_of(size);
    EXPECT_EQ(inflated(zlib_stream(bytes), size), bytes) << size;
  }
}

TEST(ZlibStream, OfPartsOfAnySizeIsThatOfTheirBytes) {
  const std::vector<std::uint8_t> bytes = bytes_of(1000);
  const std::string stream = zlib_stream(5, [&](std::size_t part, std::vector<std::uint8_t>& room) {
    const std::size_t begin = part * part * 40;  // the parts grow
    const std::size_t end = part < 4 ? (part + 1) * (part + 1) * 40 : bytes.size();
    room.assign(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end));
    return std::span<const std::uint8_t>(room);
  });
  EXPECT_EQ(inflated(stream, bytes.size()), bytes);
}

TEST(ZlibStream, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<std::uint8_t> bytes = bytes_of(5'000'000);
  const std::string stream = zlib_stream(bytes);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(zlib_stream(bytes), stream);
}

TEST(ZlibStream, IsSmallerThanZlibsFastest) {
  const std::vector<std::uint8_t> bytes = bytes_of(2'000'000);
  std::vector<std::uint8_t> fastest(compressBound(bytes.size()));
  auto size = static_cast<uLongf>(fastest.size());
  ASSERT_EQ(compress2(fastest.data(), &size, bytes.data(), bytes.size(), 1), Z_OK);
  EXPECT_LT(zlib_stream(bytes).size(), size);
}

}  // namespace wheatstone::deflate_test
