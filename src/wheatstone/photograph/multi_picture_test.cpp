#include <gtest/gtest.h>

#include "throws_error.h"
#include "wheatstone/image/image.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::multi_picture_test {

std::string jpeg_of(Rgb8 colour) { return encode_jpeg(Image<Rgb8>(24, 16, colour), 90); }

std::string joined() {
  const std::string jpegs[] = {jpeg_of({200, 10, 10}), jpeg_of({10, 200, 10}), jpeg_of({10, 10, 200})};
  return join_multi_pictures(jpegs);
}

void put_number(std::string& bytes, std::size_t at, std::uint32_t number, std::size_t length, bool little) {
  for (std::size_t i = 0; i < length; ++i)
    bytes[at + i] = static_cast<char>(number >> (8 * (little ? i : length - 1 - i)));
}

/// An index in either byte order with the least that a reader needs, before two pictures.
std::string plain_file(bool little, std::uint32_t count = 2, std::uint32_t attribute = multi_picture_disparity) {
  const std::string first = jpeg_of({200, 10, 10}), second = jpeg_of({10, 200, 10});
  const std::size_t header = 2 + 4 + 4, size = 8 + 2 + 24 + 4 + 32;
  std::string tiff(size, '\0');
  tiff.replace(0, 4, little ? std::string("II\x2A\0", 4) : std::string("MM\0\x2A", 4));
  const auto put = [&](std::size_t at, std::uint32_t number, std::size_t length) {
    put_number(tiff, at, number, length, little);
  };
  put(4, 8, 4);
  put(8, 2, 2);
  put(10, 0xB001, 2), put(12, 4, 2), put(14, 1, 4), put(18, count, 4);
  put(22, 0xB002, 2), put(24, 7, 2), put(26, 32, 4), put(30, 38, 4);
  const std::size_t first_length = first.size() + size + 8;
  put(38, attribute, 4), put(42, static_cast<std::uint32_t>(first_length), 4);
  put(54, attribute, 4), put(58, static_cast<std::uint32_t>(second.size()), 4);
  put(62, static_cast<std::uint32_t>(first_length - header), 4);
  std::string segment("\xFF\xE2\0\0MPF\0", 8);
  put_number(segment, 2, static_cast<std::uint32_t>(size + 6), 2, false);
  return first.substr(0, 2) + segment + tiff + first.substr(2) + second;
}

TEST(MultiPicture, ListsWhatWasJoined) {
  const std::string file = joined();
  const auto entries = read_multi_picture_index(file, "a.mpo");
  ASSERT_EQ(entries.size(), 3u);
  std::size_t end = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(entries[i].begin, end);
    EXPECT_EQ(entries[i].type, multi_picture_disparity);
    EXPECT_EQ(entries[i].number, i + 1);
    end += entries[i].length;
  }
  EXPECT_EQ(end, file.size());
}

TEST(MultiPicture, IsReadInEitherByteOrder) {
  for (const bool little : {false, true}) {
    const auto entries = read_multi_picture_index(plain_file(little), "a.mpo");
    ASSERT_EQ(entries.size(), 2u) << little;
    EXPECT_EQ(entries[1].begin + entries[1].length, plain_file(little).size());
    EXPECT_FALSE(entries[1].number);
  }
}

TEST(MultiPicture, WithoutAnIndexIsNone) {
  EXPECT_TRUE(read_multi_picture_index(jpeg_of({1, 2, 3}), "a.jpg").empty());
  EXPECT_TRUE(read_multi_picture_index("", "a.jpg").empty());
  EXPECT_TRUE(read_multi_picture_index("\xFF\xD8", "a.jpg").empty());
}

TEST(MultiPicture, CutAnywhereBehindItsIndexIsRefused) {
  const std::string file = joined();
  const std::size_t end_of_index = file.find("MPF") + 132;
  for (std::size_t length = end_of_index; length < file.size(); ++length)
    expect_error(ErrorKind::bad_input, "a.mpo",
                 [&] { read_multi_picture_index(std::string_view(file).substr(0, length), "a.mpo"); });
}

TEST(MultiPicture, RefusesWhatItsIndexCannotMean) {
  const auto refused = [](const std::string& file, const std::string& part) {
    expect_error(ErrorKind::bad_input, part, [&] { read_multi_picture_index(file, "a.mpo"); });
  };
  refused(plain_file(true, 0), "lists 0 pictures");
  refused(plain_file(true, 3), "length");
  refused(plain_file(true, 0xFFFFFFFF), "pictures");
  refused(plain_file(true, 2, 0x01020002), "not a JPEG");
  std::string file = plain_file(false);
  const std::size_t header = file.find("MPF") + 4;
  const auto changed = [&](std::size_t at, std::uint32_t number) {
    std::string other = file;
    put_number(other, header + at, number, 4, false);
    return other;
  };
  refused(changed(0, 0x4D4D0000), "byte order");
  refused(changed(4, 0xFFFFFFF0), "beyond its end");
  refused(changed(30, 0xFFFFFFF0), "beyond its end");
  refused(changed(58, 0x7FFFFFFF), "beyond the end of the file");
  refused(changed(58, 0), "beyond the end of the file");
  refused(changed(62, 0xFFFFFFFF), "beyond the end of the file");
  refused(changed(62, 0), "twice");
  refused(changed(62, 40), "does not begin at the listed position");
}

// Whatever one byte of the index says, the pictures that come out lie in the file.
TEST(MultiPicture, WithAnyByteOfItsIndexChangedStaysInTheFile) {
  const std::string file = joined();
  const std::size_t begin = file.find("MPF"), end = begin + 132;
  for (std::size_t at = begin; at < end; ++at) {
    for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
      std::string other = file;
      other[at] = static_cast<char>(value);
      try {
        for (const MultiPictureEntry& entry : read_multi_picture_index(other, "a.mpo"))
          ASSERT_LE(entry.begin + entry.length, other.size());
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::bad_input);
      }
    }
  }
}

}  // namespace wheatstone::multi_picture_test
