#include <gtest/gtest.h>

#include "throws_error.h"
#include "wheatstone/image/image.h"
#include "wheatstone/photograph/stereo_marks_internal.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::stereo_marks_test {

std::string plain_jpeg() { return encode_jpeg(Image<Rgb8>(24, 16, {1, 2, 3}), 90); }

TEST(JpsDescriptor, IsReadAsItWasWritten) {
  using Arrangement = JpsDescriptor::Arrangement;
  for (const Arrangement arrangement : {Arrangement::side_by_side, Arrangement::over_under}) {
    for (int flags = 0; flags < 8; ++flags) {
      const JpsDescriptor written{true, arrangement, (flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0};
      const auto read = read_jps_descriptor(with_jps_descriptor(plain_jpeg(), written), "a.jps");
      ASSERT_TRUE(read);
      EXPECT_EQ(read->arrangement, written.arrangement);
      EXPECT_EQ(read->half_height, written.half_height);
      EXPECT_EQ(read->half_width, written.half_width);
      EXPECT_EQ(read->left_first, written.left_first);
    }
  }
}

TEST(JpsDescriptor, IsNoneInAPlainJpeg) { EXPECT_FALSE(read_jps_descriptor(plain_jpeg(), "a.jpg")); }

TEST(JpsDescriptor, CutShortOrUnknownIsRefused) {
  const std::string jpeg = plain_jpeg();
  const auto with_block = [&](const std::string& block) {
    const std::string data = "_JPSJPS_" + block;
    return jpeg.substr(0, 2) + std::string("\xFF\xE3\0", 3) + static_cast<char>(data.size() + 2) + data +
           jpeg.substr(2);
  };
  const std::string whole("\0\4\0\4\2\1", 6);
  EXPECT_TRUE(read_jps_descriptor(with_block(whole), "a.jps")->left_first);
  for (std::size_t length = 0; length < whole.size(); ++length)
    expect_error(ErrorKind::bad_input, "a.jps: its stereo descriptor (JPS) is cut short",
                 [&] { read_jps_descriptor(with_block(whole.substr(0, length)), "a.jps"); });
  expect_error(ErrorKind::bad_input, "layout 9", [&] {
    read_jps_descriptor(with_block({"\0\4\0\4\11\1", 6}), "a.jps");
  });
  EXPECT_FALSE(read_jps_descriptor(with_block({"\0\4\0\4\0\0", 6}), "a.jps")->stereo);
}

TEST(StereoChunk, TellsWhichEyeComesFirst) {
  const std::string signature("\x89PNG\r\n\x1a\n"), check(4, 'c');
  const std::string data = std::string("\0\0\0\0IDAT", 8) + check;
  const auto png = [&](const std::string& chunk) { return signature + chunk + check + data; };
  EXPECT_FALSE(read_stereo_chunk(png(std::string("\0\0\0\1sTER\0", 9)))->left_first);
  EXPECT_TRUE(read_stereo_chunk(png(std::string("\0\0\0\1sTER\1", 9)))->left_first);
  EXPECT_FALSE(read_stereo_chunk(png(std::string("\0\0\0\1sTER\2", 9))));
  EXPECT_FALSE(read_stereo_chunk(png(std::string("\0\0\0\2sTER\1\1", 10))));
  EXPECT_FALSE(read_stereo_chunk(signature + data));
  EXPECT_FALSE(read_stereo_chunk(signature + std::string("\xFF\xFF\xFF\xFFsTER", 8) + check));
}

}  // namespace wheatstone::stereo_marks_test
