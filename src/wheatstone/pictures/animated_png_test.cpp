#include "wheatstone/pictures/animated_png_internal.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::animated_png_test {

std::string number(std::uint64_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  return number(data.size()) + checked +
         number(crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()));
}

constexpr int width = 5, height = 3;

/// The pixels of a picture of one colour, as IDAT holds them.
std::string pixels(Rgb8 colour) {
  std::string rows;
  for (int y = 0; y < height; ++y) {
    rows += '\0';  // no filter
    for (int x = 0; x < width; ++x)
      rows += {static_cast<char>(colour.r), static_cast<char>(colour.g), static_cast<char>(colour.b)};
  }
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size());
  packed.resize(size);
  return packed;
}

std::string control(int number_in_sequence, int left = 0) {
  return chunk("fcTL", number(number_in_sequence) + number(width) + number(height) + number(left) + number(0) +
                           std::string("\0\1\0\2\0\0", 6));
}

const std::string signature = "\x89PNG\r\n\x1a\n";
const std::string header = chunk("IHDR", number(width) + number(height) + std::string("\x08\x02\0\0\0", 5));
const std::string is_animated = chunk("acTL", number(2) + number(0));
constexpr Rgb8 red{255, 0, 0}, blue{0, 0, 255}, green{0, 255, 0};

TEST(AnimatedPng, HasItsFrames) {
  const std::string second = control(1) + chunk("fdAT", number(2) + pixels(blue));
  const std::string with_first =
      signature + header + is_animated + control(0) + chunk("IDAT", pixels(red)) + second + chunk("IEND", "");
  // The picture for programs that know no frames is none of them.
  const std::string apart = signature + header + is_animated + chunk("IDAT", pixels(green)) + control(0) +
                            chunk("fdAT", number(1) + pixels(red)) + second + chunk("IEND", "");
  const TemporaryFolder folder;
  for (const std::string& bytes : {with_first, apart}) {
    put_bytes(folder / "a.png", bytes);
    EXPECT_TRUE(may_be_animated(bytes));
    const std::vector<Image<Rgb8>> frames = read_picture_frames(folder / "a.png", 9);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0], Image<Rgb8>(width, height, red));
    EXPECT_EQ(frames[1], Image<Rgb8>(width, height, blue));
    EXPECT_EQ(read_picture_frames(folder / "a.png", 1).size(), 1u);
  }
  EXPECT_FALSE(is_animated_png(signature + header + chunk("IDAT", pixels(red)) + chunk("IEND", "")));
}

TEST(AnimatedPng, OfPartsOrCutShortIsRefused) {
  const std::string parts = signature + header + is_animated + control(0) + chunk("IDAT", pixels(red)) + control(1, 2) +
                            chunk("fdAT", number(2) + pixels(blue)) + chunk("IEND", "");
  const TemporaryFolder folder;
  put_bytes(folder / "parts.png", parts);
  expect_error(ErrorKind::bad_input, "parts.png: damaged or truncated picture: its frames do not each replace",
               [&] { read_picture_frames(folder / "parts.png", 3); });
  for (std::size_t length = signature.size(); length < parts.size(); length += 7)
    EXPECT_FALSE(frames_of_png(parts.substr(0, length), 3)) << length;
}

}  // namespace wheatstone::animated_png_test
