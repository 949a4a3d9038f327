#include "wheatstone/pictures/png_reader_internal.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace wheatstone::plain_png_test {

std::string chunk(const std::string& type, const std::string& data) {
  const auto number = [](std::uint64_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::string checked = type + data;
  return number(data.size()) + checked +
         number(crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()));
}

const std::string signature = "\x89PNG\r\n\x1a\n";
const std::string png = signature + chunk("IHDR", "size") + chunk("IDAT", "pixels") + chunk("IEND", "");

TEST(PlainPng, KeepsWhatMakesThePixels) { EXPECT_EQ(plain_png(png), png); }

TEST(PlainPng, LeavesOutProfilesCommentsAndTrailingBytes) {
  const std::string rich = signature + chunk("IHDR", "size") + chunk("iCCP", "profile") + chunk("tEXt", "a comment") +
                           chunk("IDAT", "pixels") + chunk("IEND", "") + "more";
  EXPECT_EQ(plain_png(rich), png);
}

TEST(PlainPng, IsRefusedWhenCutShort) {
  for (std::size_t length = 8; length < png.size(); ++length) EXPECT_FALSE(plain_png(png.substr(0, length))) << length;
}

TEST(PlainPng, IsRefusedWithAnyBitOfAChunkTurned) {
  for (std::size_t at = signature.size(); at < png.size(); ++at) {
    std::string damaged = png;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_FALSE(plain_png(damaged)) << "byte " << at;
  }
}

}  // namespace wheatstone::plain_png_test
