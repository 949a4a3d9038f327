#include "wheatstone/pictures/jpeg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace wheatstone::jpeg_test {

// A thumbnail's end marker inside a segment, then a scan, then the real end marker.
const std::string whole(
    "\xFF\xD8"
    "\xFF\xE1\x00\x06\x01\xFF\xD9\x02"
    "\xFF\xDA\x00\x03\x00"
    "data\xFF\x00more"
    "\xFF\xD9",
    27);

TEST(JpegEnd, IsFoundInAWholeFile) { EXPECT_TRUE(jpeg_is_whole(whole)); }

TEST(JpegEnd, IsFoundBeforeTrailingBytes) { EXPECT_TRUE(jpeg_is_whole(whole + "camera's own bytes")); }

TEST(JpegEnd, IsMissingFromEveryPartOfAFile) {
  for (std::size_t length = 4; length < whole.size(); ++length) {
    EXPECT_FALSE(jpeg_is_whole(whole.substr(0, length))) << length << " bytes";
  }
}

StoredPicture described(int width, int height, int channels) {
  StoredPicture picture{width, height, channels};
  picture.kind = bytes_kind;
  return picture;
}

TEST(Jpeg, ComesBackNearlyAsItWas) {
  for (const int channels : {1, 3}) {
    constexpr int width = 40, height = 30;
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) pixels.push_back(static_cast<std::uint8_t>(40 + 4 * x + 2 * y - 20 * c));
    const PixelRows rows{pixels.data(), bytes_kind, 0, height, std::ptrdiff_t{width} * channels};
    const EncodedPicture jpeg = encode_jpeg(described(width, height, channels), rows, 95);
    ASSERT_EQ(jpeg.complaint, "");
    EXPECT_TRUE(is_jpeg(jpeg.bytes) && jpeg_is_whole(jpeg.bytes));
    const OpenedPicture opened = open_jpeg_bytes(jpeg.bytes);
    ASSERT_TRUE(opened.reader) << opened.complaint;
    EXPECT_EQ(opened.reader->format(), "jpeg");
    EXPECT_EQ(opened.reader->picture().width, width);
    EXPECT_EQ(opened.reader->picture().height, height);
    ASSERT_EQ(opened.reader->picture().channels, channels);
    std::vector<float> row(static_cast<std::size_t>(width * channels));
    ASSERT_TRUE(opened.reader->read(7, 1, channels, row.data()));
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_NEAR(255 * row[i], pixels[7 * static_cast<std::size_t>(width * channels) + i], 4);
  }
}

TEST(Jpeg, IsDecodedSmallWhereThatIsWideEnough) {
  constexpr int width = 200, height = 104;
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) pixels.push_back(static_cast<std::uint8_t>(x + y / 2));
  const EncodedPicture jpeg =
      encode_jpeg(described(width, height, 1), {pixels.data(), bytes_kind, 0, height, width}, 95);
  for (const auto& [least_side, divisor] : {std::pair{105, 1}, {53, 1}, {52, 2}, {26, 4}, {14, 4}, {13, 8}, {1, 8}}) {
    const OpenedPicture opened = open_jpeg_bytes(jpeg.bytes, least_side);
    ASSERT_TRUE(opened.reader) << opened.complaint;
    const StoredPicture& picture = opened.reader->picture();
    EXPECT_EQ(picture.width, width / divisor) << least_side;
    EXPECT_EQ(picture.height, height / divisor) << least_side;
    std::vector<std::uint8_t> small(static_cast<std::size_t>(picture.width * picture.height));
    ASSERT_TRUE(opened.reader->read(small.data()));
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const double mean = (x + 0.5 + (y + 0.5) / 2) * divisor - 0.75;
        EXPECT_NEAR(small[static_cast<std::size_t>(y * picture.width + x)], mean, 4) << x << " " << y;
      }
  }
}

TEST(Jpeg, ThatCannotBeReadOrWrittenSaysWhy) {
  const OpenedPicture damaged = open_jpeg_bytes("\xFF\xD8\xFF\xDAnothing that is a scan\xFF\xD9");
  EXPECT_FALSE(damaged.reader);
  EXPECT_NE(damaged.complaint, "");
  const std::vector<std::uint8_t> row(70'000);
  EXPECT_THAT(encode_jpeg(described(70'000, 1, 1), {row.data(), bytes_kind, 0, 1, 70'000}, 95).complaint,
              testing::HasSubstr("65500"));
}

TEST(JpegEnd, IsNotAskedOfOtherFiles) { EXPECT_TRUE(jpeg_is_whole("\x89PNG\r\n")); }

}  // namespace wheatstone::jpeg_test
