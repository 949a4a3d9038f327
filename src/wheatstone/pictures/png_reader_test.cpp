#include "wheatstone/pictures/png_reader_internal.h"

#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <random>

#include "temporary_folder.h"
#include "wheatstone/pictures/png_chunks.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone::png_reader_test {

constexpr int width = 13, height = 9;

struct Kind {
  int colours, bits;
  bool has_transparent_colour = false;
};

constexpr Kind kinds[] = {
    {PNG_COLOR_TYPE_GRAY, 1},       {PNG_COLOR_TYPE_GRAY, 2},          {PNG_COLOR_TYPE_GRAY, 4, true},
    {PNG_COLOR_TYPE_GRAY, 8},       {PNG_COLOR_TYPE_GRAY, 16},         {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
    {PNG_COLOR_TYPE_PALETTE, 2},    {PNG_COLOR_TYPE_PALETTE, 8, true}, {PNG_COLOR_TYPE_RGB, 8},
    {PNG_COLOR_TYPE_RGB, 16, true}, {PNG_COLOR_TYPE_RGB_ALPHA, 8},     {PNG_COLOR_TYPE_RGB_ALPHA, 16}};

void put_colours(png_structp png, png_infop info, const Kind& kind) {
  if (kind.colours == PNG_COLOR_TYPE_PALETTE) {
    std::vector<png_color> palette;
    for (int i = 0; i < 1 << kind.bits; ++i)
      palette.push_back({static_cast<png_byte>(i), static_cast<png_byte>(3 * i), static_cast<png_byte>(255 - i)});
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
  }
  const png_byte alphas[] = {0, 77, 200};
  const png_color_16 transparent{0, 5, 6, 7, 3};
  if (kind.has_transparent_colour) png_set_tRNS(png, info, alphas, 3, &transparent);
}

/// A PNG of noise, as any program may write it.
std::string noise(const Kind& kind, int interlacing) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  const auto append = [](png_structp from, png_bytep data, std::size_t count) {
    static_cast<std::string*>(png_get_io_ptr(from))->append(reinterpret_cast<const char*>(data), count);
  };
  png_set_write_fn(png, &bytes, append, [](png_structp) {});
  png_set_IHDR(png, info, width, height, kind.bits, kind.colours, interlacing, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  put_colours(png, info, kind);
  png_write_info(png, info);
  std::mt19937 random(7);
  std::vector<png_byte> pixels(height * png_get_rowbytes(png, info));
  for (png_byte& byte : pixels) byte = static_cast<png_byte>(random());
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < height; ++y) rows.push_back(pixels.data() + y * png_get_rowbytes(png, info));
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::vector<float> all_of(PictureReader& reader) {
  const StoredPicture& picture = reader.picture();
  std::vector<float> values(static_cast<std::size_t>(picture.width * picture.height * picture.channels));
  EXPECT_TRUE(reader.read(0, picture.height, picture.channels, values.data())) << reader.complaint();
  return values;
}

TEST(PngReader, ReadsEveryKindAsOpenImageIODoes) {
  const TemporaryFolder folder;
  for (const Kind& kind : kinds) {
    for (const int interlacing : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
      for (const StoredAlpha alpha : {StoredAlpha::kept_apart, StoredAlpha::multiplied}) {
        SCOPED_TRACE(testing::Message() << kind.colours << " " << kind.bits << " " << interlacing);
        const std::string png = noise(kind, interlacing);
        put_bytes(folder / "noise.png", png);
        const OpenedPicture theirs = open_picture_file(folder / "noise.png", alpha);
        const OpenedPicture ours = open_png_bytes(png, alpha);
        ASSERT_TRUE(theirs.reader && ours.reader) << theirs.complaint << ours.complaint;
        const StoredPicture &expected = theirs.reader->picture(), &found = ours.reader->picture();
        ASSERT_EQ(found.width, expected.width);
        ASSERT_EQ(found.height, expected.height);
        ASSERT_EQ(found.channels, expected.channels);
        EXPECT_EQ(found.kind, expected.kind);
        EXPECT_EQ(found.alpha_channel, expected.alpha_channel);
        if (found.alpha_channel >= 0) {
          EXPECT_EQ(found.value_of("oiio:UnassociatedAlpha", 0), expected.value_of("oiio:UnassociatedAlpha", 0));
        }
        EXPECT_EQ(all_of(*ours.reader), all_of(*theirs.reader));
      }
    }
  }
}

std::string number_of(std::size_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
  return bytes;
}

std::string chunk_of(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  return number_of(data.size()) + checked +
         number_of(crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size()));
}

TEST(PngReader, SaysOfDamagedPixelsWhatIsWrong) {
  const std::string png = noise({PNG_COLOR_TYPE_RGB, 8}, PNG_INTERLACE_NONE);
  const auto chunks = png_chunks(png);
  ASSERT_TRUE(chunks);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    std::string damaged = png.substr(0, png_signature_size);
    for (const PngChunk& chunk : *chunks) {
      std::string data(chunk.data);
      if (chunk.type == "IDAT") data[i] = static_cast<char>(data[i] ^ 0x55);
      damaged += chunk_of(std::string(chunk.type), data);
    }
    const OpenedPicture opened = open_png_bytes(damaged, StoredAlpha::kept_apart);
    ASSERT_TRUE(opened.reader);
    std::vector<std::uint8_t> pixels(std::size_t{3} * width * height);
    if (opened.reader->read(pixels.data())) continue;
    EXPECT_NE(opened.reader->complaint(), "");
    ++refused;
  }
  EXPECT_GT(refused, 0u);
}

TEST(PngReader, RefusesAHeaderThatNoPngHas) {
  std::string png = noise({PNG_COLOR_TYPE_RGB, 8}, PNG_INTERLACE_NONE).substr(0, png_signature_size);
  png += chunk_of("IHDR", std::string("\0\0\0\x10\0\0\0\0\x08\x02\0\0\0", 13)) + chunk_of("IEND", "");
  const OpenedPicture opened = open_png_bytes(png, StoredAlpha::kept_apart);
  EXPECT_FALSE(opened.reader);
  EXPECT_NE(opened.complaint, "");
}

TEST(PngReader, TellsHowAPictureIsTurned) {
  const std::string entry("\x01\x12\0\x03\0\0\0\1\0\6\0\0", 12), mirrored("\x12\x01\x03\0\1\0\0\0\5\0\0\0", 12);
  const std::string big_endian = std::string("MM\0\x2a\0\0\0\x08\0\1", 10) + entry + std::string(4, '\0');
  const std::string little_endian = std::string("II\x2a\0\x08\0\0\0\1\0", 10) + mirrored + std::string(4, '\0');
  EXPECT_EQ(exif_orientation(big_endian), 6);
  EXPECT_EQ(exif_orientation(little_endian), 5);
  for (std::size_t length = 0; length < 19; ++length) EXPECT_EQ(exif_orientation(big_endian.substr(0, length)), 1);
  const std::string png = noise({PNG_COLOR_TYPE_GRAY, 8}, PNG_INTERLACE_NONE);
  const std::size_t after_header = png_signature_size + 25;
  const std::string turned = png.substr(0, after_header) + chunk_of("eXIf", big_endian) + png.substr(after_header);
  EXPECT_EQ(open_png_bytes(turned, StoredAlpha::kept_apart).reader->picture().value_of("Orientation", 1), 6);
}

}  // namespace wheatstone::png_reader_test
