#include "wheatstone/pictures/read_image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::read_image_test {

namespace fs = std::filesystem;

// A picture without two equal pixels in a row or column.
Image<Rgb8> ramp(int width, int height) {
  Image<Rgb8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = {static_cast<std::uint8_t>(7 * x + 1), static_cast<std::uint8_t>(11 * y + 2),
                     static_cast<std::uint8_t>(x + 13 * y)};
    }
  }
  return image;
}

// Writes raw values in any layout: what cameras and other programs leave.
template <class Value>
void put_picture(const fs::path& path, OIIO::ImageSpec spec, const std::vector<Value>& values) {
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), spec) &&
              output->write_image(OIIO::BaseTypeFromC<Value>::value, values.data()) && output->close())
      << (output ? output->geterror() : OIIO::geterror());
}

OIIO::ImageSpec layout(int width, int height, int channels, OIIO::TypeDesc type) {
  return {width, height, channels, type};
}

void expect_near(Rgb8 found, Rgb8 expected, int tolerance) {
  EXPECT_LE(std::abs(found.r - expected.r), tolerance) << int(found.r);
  EXPECT_LE(std::abs(found.g - expected.g), tolerance) << int(found.g);
  EXPECT_LE(std::abs(found.b - expected.b), tolerance) << int(found.b);
}

TEST(ReadImage, OfAGifHasItsColours) {
  const TemporaryFolder folder;
  const auto output = OIIO::ImageOutput::create("a.gif");
  ASSERT_TRUE(output->open(folder / "a.gif", OIIO::ImageSpec(16, 16, 3, OIIO::TypeDesc::UINT8)));
  const Image<Rgb8> blue(16, 16, {0, 0, 255});
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, blue.pixels().data()) && output->close());
  const Rgb8 found = read_image(folder / "a.gif")(8, 8);
  EXPECT_LT(found.r, 8);
  EXPECT_GT(found.b, 247);
}

TEST(ReadImage, TurnsGreyIntoThreeEqualChannels) {
  const TemporaryFolder folder;
  put_picture<std::uint8_t>(folder / "grey.png", layout(2, 1, 1, OIIO::TypeDesc::UINT8), {10, 200});
  const Image<Rgb8> image = read_image(folder / "grey.png");
  EXPECT_EQ(image(0, 0), (Rgb8{10, 10, 10}));
  EXPECT_EQ(image(1, 0), (Rgb8{200, 200, 200}));
}

TEST(ReadImage, RoundsSixteenBits) {
  const TemporaryFolder folder;
  for (const char* name : {"deep.png", "deep.tif"}) {
    // 257 steps of 16 bits are one of 8: 128 above a step is nearer to it, 129 nearer to the next.
    put_picture<std::uint16_t>(folder / name, layout(1, 1, 3, OIIO::TypeDesc::UINT16),
                               {257 * 5, 257 * 5 + 128, 257 * 5 + 129});
    EXPECT_EQ(read_image(folder / name)(0, 0), (Rgb8{5, 5, 6})) << name;
  }
}

TEST(ReadImage, KeepsSixteenBitsForWhoAsks) {
  const TemporaryFolder folder;
  for (const char* name : {"deep.png", "deep.tif"}) {
    put_picture<std::uint16_t>(folder / name, layout(1, 1, 3, OIIO::TypeDesc::UINT16), {1, 257 * 5 + 128, 65534});
    EXPECT_EQ(read_deep_image(folder / name)(0, 0), (Rgb16{1, 257 * 5 + 128, 65534})) << name;
  }
  put_picture<float>(folder / "light.exr", layout(1, 1, 3, OIIO::TypeDesc::FLOAT), {0.f, 0.25f, 1.f});
  const Rgb16 light = read_deep_image(folder / "light.exr")(0, 0);
  EXPECT_EQ(light.r, 0);
  EXPECT_NEAR(light.g, 65535 * (1.055 * std::pow(0.25, 1 / 2.4) - 0.055), 1);
  EXPECT_EQ(light.b, 65535);
  put_picture<std::uint8_t>(folder / "flat.png", layout(1, 1, 3, OIIO::TypeDesc::UINT8), {1, 2, 3});
  EXPECT_TRUE(read_deep_image(folder / "flat.png").empty());
}

TEST(ReadImage, CompositesAlphaOverWhite) {
  const TemporaryFolder folder;
  put_picture<std::uint8_t>(folder / "sheer.png",
                            [] {
                              OIIO::ImageSpec spec = layout(3, 1, 4, OIIO::TypeDesc::UINT8);
                              spec.attribute("oiio:UnassociatedAlpha", 1);
                              return spec;
                            }(),
                            {200, 100, 0, 0, 200, 100, 0, 51, 200, 100, 0, 255});
  const Image<Rgb8> image = read_image(folder / "sheer.png");
  EXPECT_EQ(image(0, 0), (Rgb8{255, 255, 255}));
  EXPECT_EQ(image(1, 0), (Rgb8{244, 224, 204}));  // a fifth of the colour, four fifths of white
  EXPECT_EQ(image(2, 0), (Rgb8{200, 100, 0}));
}

TEST(ReadImage, CompositesPremultipliedAlphaOverWhite) {
  const TemporaryFolder folder;
  put_picture<std::uint8_t>(folder / "sheer.tif", layout(1, 1, 4, OIIO::TypeDesc::UINT8), {40, 20, 0, 51});
  EXPECT_EQ(read_image(folder / "sheer.tif")(0, 0), (Rgb8{244, 224, 204}));
}

TEST(ReadImage, EncodesLinearFloats) {
  const TemporaryFolder folder;
  put_picture<float>(folder / "light.exr", layout(2, 1, 3, OIIO::TypeDesc::FLOAT), {0.2140f, 0, 1, 2, -1, 0.5f});
  const Image<Rgb8> image = read_image(folder / "light.exr");
  EXPECT_EQ(image(0, 0), (Rgb8{127, 0, 255}));  // linear 0.214 is sRGB 0.5
  EXPECT_EQ(image(1, 0), (Rgb8{255, 0, 188}));  // out of range is cut off
}

TEST(ReadImage, TurnsAPhotographUpright) {
  const Image<Rgb8> stored = ramp(3, 2);
  // EXIF 2.3, "Orientation": where row 0 and column 0 of the stored picture are shown.
  const auto shown = [&](int orientation, int x, int y) {
    switch (orientation) {
      case 2:
        return stored(2 - x, y);
      case 3:
        return stored(2 - x, 1 - y);
      case 4:
        return stored(x, 1 - y);
      case 5:
        return stored(y, x);
      case 6:
        return stored(y, 1 - x);
      case 7:
        return stored(2 - y, 1 - x);
      case 8:
        return stored(2 - y, x);
      default:
        return stored(x, y);
    }
  };
  const TemporaryFolder folder;
  for (int orientation = 1; orientation <= 8; ++orientation) {
    OIIO::ImageSpec spec = layout(3, 2, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Orientation", orientation);
    const auto* first = reinterpret_cast<const std::uint8_t*>(stored.pixels().data());
    put_picture<std::uint8_t>(folder / "turned.tif", spec, {first, first + 18});
    const Image<Rgb8> image = read_image(folder / "turned.tif");
    ASSERT_EQ(image.width(), orientation < 5 ? 3 : 2);
    ASSERT_EQ(image.height(), orientation < 5 ? 2 : 3);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        EXPECT_EQ(image(x, y), shown(orientation, x, y)) << "orientation " << orientation << " at " << x << ", " << y;
      }
    }
  }
}

/// A field of a TIFF, little-endian.
std::string entry(int tag, int type, int count, int value) {
  std::string bytes;
  for (const auto& [number, length] : {std::pair{tag, 2}, {type, 2}, {count, 4}, {value, 4}}) {
    for (int i = 0; i < length; ++i) bytes += static_cast<char>(number >> (8 * i));
  }
  return bytes;
}

TEST(ReadImage, OfATiffThatDoesNotTellItsBitsHasOneBit) {
  // One strip of two rows of ten pixels: black is 0, and the bits begin with the highest.
  const std::string head("II\x2a\0\x0c\0\0\0\xa5\x40\x0f\x80", 12);
  const std::string tiff = head + std::string("\x07\0", 2) + entry(256, 3, 1, 10) + entry(257, 3, 1, 2) +
                           entry(259, 3, 1, 1) + entry(262, 3, 1, 1) + entry(273, 4, 1, 8) + entry(278, 3, 1, 2) +
                           entry(279, 4, 1, 4) + std::string(4, '\0');
  const TemporaryFolder folder;
  put_bytes(folder / "a.tif", tiff);
  const Image<Rgb8> picture = read_image(folder / "a.tif");
  ASSERT_EQ(picture.width(), 10);
  ASSERT_EQ(picture.height(), 2);
  constexpr std::array<std::string_view, 2> expected{"#.#..#.#.#", "....#####."};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 10; ++x) {
      const std::uint8_t level = expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
      EXPECT_EQ(picture(x, y), (Rgb8{level, level, level})) << x << ' ' << y;
    }
  put_bytes(folder / "short.tif", tiff.substr(0, tiff.size() - 40));
  expect_error(ErrorKind::bad_input, "short.tif", [&] { read_image(folder / "short.tif"); });
}

TEST(ReadImage, ConvertsACmykTiff) {
  // Little-endian; one strip of one pixel: cyan 0, magenta 204, yellow 229, black 55.
  const std::string head(
      "II\x2a\0\x14\0\0\0"
      "\0\xcc\xe5\x37"
      "\x08\0\x08\0\x08\0\x08\0",
      20);
  const std::string tiff = head + std::string("\x09\0", 2) + entry(256, 3, 1, 1) + entry(257, 3, 1, 1) +
                           entry(258, 3, 4, 12) + entry(259, 3, 1, 1) + entry(262, 3, 1, 5) + entry(273, 4, 1, 8) +
                           entry(277, 3, 1, 4) + entry(278, 3, 1, 1) + entry(279, 4, 1, 4) + std::string(4, '\0');
  const TemporaryFolder folder;
  put_bytes(folder / "print.tif", tiff);
  expect_near(read_image(folder / "print.tif")(0, 0), {200, 40, 20}, 1);
}

TEST(ReadImage, ConvertsACmykJpeg) {
  // 8x8 pixels of (200, 40, 20) as YCbCrK, as ImageMagick writes them.
  constexpr unsigned char jpeg[] = {
      0xff, 0xd8, 0xff, 0xee, 0x00, 0x0e, 0x41, 0x64, 0x6f, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00, 0x02, 0xff,
      0xdb, 0x00, 0x43, 0x00, 0x03, 0x02, 0x02, 0x03, 0x02, 0x02, 0x03, 0x03, 0x03, 0x03, 0x04, 0x03, 0x03, 0x04, 0x05,
      0x08, 0x05, 0x05, 0x04, 0x04, 0x05, 0x0a, 0x07, 0x07, 0x06, 0x08, 0x0c, 0x0a, 0x0c, 0x0c, 0x0b, 0x0a, 0x0b, 0x0b,
      0x0d, 0x0e, 0x12, 0x10, 0x0d, 0x0e, 0x11, 0x0e, 0x0b, 0x0b, 0x10, 0x16, 0x10, 0x11, 0x13, 0x14, 0x15, 0x15, 0x15,
      0x0c, 0x0f, 0x17, 0x18, 0x16, 0x14, 0x18, 0x12, 0x14, 0x15, 0x14, 0xff, 0xdb, 0x00, 0x43, 0x01, 0x03, 0x04, 0x04,
      0x05, 0x04, 0x05, 0x09, 0x05, 0x05, 0x09, 0x14, 0x0d, 0x0b, 0x0d, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14,
      0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14,
      0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14, 0x14,
      0x14, 0x14, 0x14, 0x14, 0xff, 0xc0, 0x00, 0x14, 0x08, 0x00, 0x08, 0x00, 0x08, 0x04, 0x01, 0x11, 0x00, 0x02, 0x11,
      0x01, 0x03, 0x11, 0x01, 0x04, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x15, 0x00, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06, 0x08, 0xff, 0xc4, 0x00, 0x14, 0x10, 0x01, 0x00, 0x00,
      0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xc4, 0x00, 0x15, 0x01,
      0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x07, 0x09, 0xff,
      0xc4, 0x00, 0x14, 0x11, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
      0x00, 0x00, 0xff, 0xda, 0x00, 0x0e, 0x04, 0x01, 0x00, 0x02, 0x11, 0x03, 0x11, 0x04, 0x00, 0x00, 0x3f, 0x00, 0x60,
      0x7d, 0x4e, 0xa5, 0x80, 0xff, 0xd9};
  const TemporaryFolder folder;
  put_bytes(folder / "print.jpg", {reinterpret_cast<const char*>(jpeg), sizeof jpeg});
  expect_near(read_image(folder / "print.jpg")(4, 4), {200, 40, 20}, 2);
}

TEST(ReadImage, KnowsAPictureByItsBytesNotByItsName) {
  const TemporaryFolder folder;
  write_image(folder / "picture.png", ramp(4, 3));
  fs::rename(folder / "picture.png", folder / "picture.jpg");
  EXPECT_EQ(read_image(folder / "picture.jpg"), ramp(4, 3));
}

// A part of a file is refused, or what is cut off did not matter: never a picture with missing rows.
class ReadImageCutShort : public testing::TestWithParam<const char*> {};

TEST_P(ReadImageCutShort, IsRefusedOrWhole) {
  const TemporaryFolder folder;
  const fs::path path = folder / (std::string("picture.") + GetParam());
  write_image(path, ramp(33, 21));
  const std::string bytes = bytes_of(path);
  const Image<Rgb8> whole = read_image(path);
  std::size_t refused = 0;
  std::size_t tried = 0;
  // Every length that may end within a header, and a sample of the others.
  for (std::size_t length = 0; length < bytes.size(); length += length < 300 ? 1 : 17) {
    put_bytes(path, std::string_view(bytes).substr(0, length));
    ++tried;
    try {
      ASSERT_EQ(read_image(path), whole) << "cut to " << length << " of " << bytes.size() << " bytes";
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::bad_input);
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, tried * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Formats, ReadImageCutShort, testing::Values("png", "jpg", "tif", "webp", "ppm", "bmp"),
                         [](const auto& format) { return std::string(format.param); });

TEST(ReadImage, RefusesWhatIsNoPicture) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::bad_input, "missing.png: no such file", [&] { read_image(folder / "missing.png"); });
  expect_error(ErrorKind::bad_input, "is a folder", [&] { read_image(folder / ""); });
  put_bytes(folder / "empty.png", "");
  expect_error(ErrorKind::bad_input, "empty.png: is empty", [&] { read_image(folder / "empty.png"); });
  put_bytes(folder / "letter.png", "Dear Sir, this is no picture at all, but a letter of some length. Yours.\n");
  expect_error(ErrorKind::bad_input, "letter.png: not a picture", [&] { read_image(folder / "letter.png"); });
  fs::rename(folder / "letter.png", folder / "letter.txt");
  expect_error(ErrorKind::bad_input, "letter.txt: not a picture", [&] { read_image(folder / "letter.txt"); });
}

TEST(ReadImage, RefusesSizesThatNoPictureHas) {
  const TemporaryFolder folder;
  put_bytes(folder / "none.ppm", "P6\n0 0\n255\n");
  expect_error(ErrorKind::bad_input, "none.ppm", [&] { read_image(folder / "none.ppm"); });
  put_bytes(folder / "huge.ppm", "P6\n60000 60000\n255\nx");
  expect_error(ErrorKind::bad_input, "huge.ppm: 60000x60000 pixels", [&] { read_image(folder / "huge.ppm"); });
}

TEST(ReadImage, BelievesNoHeaderOfABmpThatItsLengthBelies) {
  const TemporaryFolder folder;
  write_image(folder / "a.bmp", ramp(8, 8));
  std::string bytes = bytes_of(folder / "a.bmp");
  // Width and height are little-endian numbers at bytes 18 and 22.
  for (const std::size_t at : {18, 22}) bytes.replace(at, 4, std::string("\x40\x60\x00\x00", 4));
  put_bytes(folder / "a.bmp", bytes);
  expect_error(ErrorKind::bad_input, "its header says 24640x24640 pixels, but the file has",
               [&] { read_image(folder / "a.bmp"); });
}

TEST(ReadTwoImages, ReadsBothAndTellsTheErrorOfTheFirst) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", ramp(8, 6));
  write_image(folder / "b.png", ramp(9, 7));
  const auto [a, b] = read_two_images(folder / "a.png", folder / "b.png");
  EXPECT_EQ(a, ramp(8, 6));
  EXPECT_EQ(b, ramp(9, 7));
  for (int i = 0; i < 20; ++i)
    expect_error(ErrorKind::bad_input, "first.png",
                 [&] { read_two_images(folder / "first.png", folder / "second.png"); });
  expect_error(ErrorKind::bad_input, "second.png", [&] { read_two_images(folder / "a.png", folder / "second.png"); });
}

}  // namespace wheatstone::read_image_test
