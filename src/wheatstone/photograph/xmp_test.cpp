#include <gtest/gtest.h>

#include "scenes/xmp_pictures.h"
#include "throws_error.h"
#include "wheatstone/photograph/xmp_internal.h"

namespace wheatstone::xmp_test {

const std::string bare_jpeg("\xFF\xD8\xFF\xD9", 4);

TEST(Xmp, HasPropertiesAsAttributesAndAsElements) {
  const Xmp xmp = read_xmp(
      with_segments(bare_jpeg, packet_segment("A:One=\"1\" A:OneMore = '2'", "<A:Three>3</A:Three>")), "a.jpg");
  EXPECT_EQ(xmp_property(xmp, "A:One"), "1");
  EXPECT_EQ(xmp_property(xmp, "A:OneMore"), "2");
  EXPECT_EQ(xmp_property(xmp, "A:Three"), "3");
  EXPECT_EQ(xmp_property(xmp, "A:Four"), std::nullopt);
  EXPECT_EQ(xmp_property(xmp, "One"), std::nullopt);
  EXPECT_TRUE(read_xmp(bare_jpeg, "a.jpg").packet.empty());
  EXPECT_TRUE(read_xmp("no JPEG", "a.jpg").packet.empty());
  EXPECT_EQ(xmp_property(std::string_view("<a B:C=\"open"), "B:C"), std::nullopt);
  EXPECT_EQ(xmp_property(std::string_view("<B:C>open"), "B:C"), std::nullopt);
}

TEST(Xmp, PutsItsExtendedPartTogether) {
  const std::string bytes(1000, 'x');
  const std::string jpeg = with_extended_data(bare_jpeg, "A:One=\"1\"", "A:Data", bytes, 300);
  const Xmp xmp = read_xmp(jpeg, "a.jpg");
  EXPECT_EQ(decode_base64(xmp_property(xmp, "A:Data").value()), bytes);
  EXPECT_EQ(xmp_property(xmp, "A:One"), "1");
}

TEST(Xmp, RefusesAnExtendedPartThatIsNotWhole) {
  const std::string note = "xmpNote:HasExtendedXMP=\"" + std::string(extended_guid) + "\"";
  const std::string text(1000, 'x'), whole = extended_segments(text, 500);
  const auto read = [&](const std::string& extended) {
    return read_xmp(with_segments(bare_jpeg, packet_segment(note) + extended), "a.jpg");
  };
  EXPECT_EQ(read(whole).extended, text);
  const std::size_t half = whole.size() / 2;
  expect_error(ErrorKind::bad_input, "a.jpg: its extended XMP is damaged: a chunk is missing", [&] { read(""); });
  expect_error(ErrorKind::bad_input, "a chunk is missing", [&] { read(whole.substr(0, half)); });
  expect_error(ErrorKind::bad_input, "overlap", [&] { read(whole + whole); });
  std::string changed = whole;
  const std::size_t length_at = 4 + 35 + 32;
  changed.replace(length_at, 4, number_bytes(999));
  expect_error(ErrorKind::bad_input, "differ about its length", [&] { read(changed); });
  changed.replace(length_at, 4, number_bytes(0xFFFFFFF0));
  expect_error(ErrorKind::bad_input, "longer than the file", [&] { read(changed); });
  changed = whole;
  changed.replace(length_at + 4, 4, number_bytes(501));
  expect_error(ErrorKind::bad_input, "beyond its end", [&] { read(changed); });
  expect_error(ErrorKind::bad_input, "cut short",
               [&] { read(app1_segment(std::string("http://ns.adobe.com/xmp/extension/\0", 35) + "short")); });
}

TEST(Xmp, DecodesBase64) {
  EXPECT_EQ(decode_base64(""), "");
  for (const std::string bytes : {"a", "ab", "abc", "abcd"}) EXPECT_EQ(decode_base64(base64_of(bytes)), bytes);
  EXPECT_EQ(decode_base64("YW\n J&#10;j"), "abc");
  EXPECT_EQ(decode_base64("YW-j"), std::nullopt);
  EXPECT_EQ(decode_base64("YW&j"), std::nullopt);
}

}  // namespace wheatstone::xmp_test
