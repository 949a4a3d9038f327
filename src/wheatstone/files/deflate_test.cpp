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

std::vector<std::uint8_t> inflated_by_zlib(const std::string& stream, std::size_t size) {
  std::vector<std::uint8_t> bytes(size + 1);
  auto made = static_cast<uLongf>(bytes.size());
  EXPECT_EQ(uncompress(bytes.data(), &made, reinterpret_cast<const Bytef*>(stream.data()), stream.size()), Z_OK);
  bytes.resize(made);
  return bytes;
}

TEST(ZlibStream, IsReadByZlib) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, std::size_t{3'500'001}}) {
    const std::vector<std::uint8_t> bytes = bytes_of(size);
    EXPECT_EQ(inflated_by_zlib(zlib_stream(bytes), size), bytes) << size;
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
  EXPECT_EQ(inflated_by_zlib(stream, bytes.size()), bytes);
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

TEST(Inflated, IsWhatWasDeflatedByUsAndByZlib) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, std::size_t{3'500'001}}) {
    const std::vector<std::uint8_t> bytes = bytes_of(size);
    EXPECT_EQ(inflated(deflated(bytes), size), bytes) << size;
    for (const int level : {0, 1}) EXPECT_EQ(inflated(deflated(bytes, level), size), bytes) << size << ' ' << level;
  }
}

TEST(Inflated, IsNothingWhereTheStreamIsDamagedOrOfAnotherSize) {
  const std::vector<std::uint8_t> bytes = bytes_of(4000);
  const std::vector<std::uint8_t> stream = deflated(bytes);
  for (std::size_t size = 0; size < stream.size(); ++size)
    EXPECT_FALSE(inflated(std::span(stream).first(size), bytes.size())) << size;
  EXPECT_FALSE(inflated(stream, bytes.size() - 1));
  EXPECT_FALSE(inflated(stream, bytes.size() + 1));
  for (const std::size_t more : {1, 2, 7, 8, 9, 100}) {  // of which the decoder may read some ahead
    std::vector<std::uint8_t> longer = stream;
    longer.resize(stream.size() + more);
    EXPECT_FALSE(inflated(longer, bytes.size())) << more;
  }
  for (std::size_t i = 0; i < stream.size(); ++i) {
    std::vector<std::uint8_t> bad = stream;
    bad[i] ^= 0x10;
    EXPECT_FALSE(inflated(bad, bytes.size())) << i;
  }
}

}  // namespace wheatstone::deflate_test
