#include "wheatstone/photograph/read_views.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "scenes/heif_pictures.h"
#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

constexpr Rgb8 red{200, 30, 30}, blue{30, 30, 200};

bool is_like(const Image<Rgb8>& picture, Rgb8 colour) {
  const Rgb8 found = picture(picture.width() / 2, picture.height() / 2);
  return std::abs(found.r - colour.r) < 12 && std::abs(found.b - colour.b) < 12;
}

std::string two_colours_mpo(const std::vector<Rgb8>& colours = {red, blue}) {
  std::vector<std::string> jpegs;
  for (const Rgb8 colour : colours) jpegs.push_back(encode_jpeg(Image<Rgb8>(40, 32, colour), 95));
  return join_multi_pictures(jpegs);
}

/// Changes the `which`-th of the bytes that stand for this number (tag and what precedes its value).
void replace_once(std::string& bytes, const std::string& from, const std::string& to, std::size_t begin = 0) {
  const std::size_t at = bytes.find(from, begin);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, from.size(), to);
}

std::string number_field(int number) {
  return std::string("\xB1\x01\0\4\0\0\0\1\0\0\0", 11) + static_cast<char>(number);
}

TEST(ReadViews, OfAnMpoAreItsPicturesFromTheLeft) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.mpo", two_colours_mpo());
  ViewsFile file = read_views(folder / "a.mpo");
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_TRUE(is_like(file.views[0], red));
  EXPECT_TRUE(is_like(file.views[1], blue));
  EXPECT_EQ(file.layout, std::nullopt);
  EXPECT_EQ(describe_views(file), "MPO, 2 pictures (from its metadata)");
  file = read_views(folder / "a.mpo", {.swap = true});
  EXPECT_TRUE(is_like(file.views[0], blue));
  // By its bytes, not by its name.
  put_bytes(folder / "a.jpg", two_colours_mpo());
  EXPECT_EQ(read_views(folder / "a.jpg").views.size(), 2u);
}

TEST(ReadViews, OfAnMpoFollowTheNumbersThatThePicturesTell) {
  const TemporaryFolder folder;
  std::string bytes = two_colours_mpo();
  replace_once(bytes, number_field(2), number_field(3));
  replace_once(bytes, number_field(1), number_field(7));
  put_bytes(folder / "a.mpo", bytes);
  const ViewsFile file = read_views(folder / "a.mpo");
  EXPECT_TRUE(is_like(file.views[0], blue));
  EXPECT_TRUE(is_like(file.views[1], red));
}

TEST(ReadViews, OfAnMpoCutAnywhereAreRefused) {
  const TemporaryFolder folder;
  const std::string bytes = two_colours_mpo();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    put_bytes(folder / "a.mpo", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "a.mpo: ", [&] { read_views(folder / "a.mpo"); });
  }
}

TEST(ReadViews, OfAnMpoWithOnePictureOrNoIndexAreRefused) {
  const TemporaryFolder folder;
  put_bytes(folder / "one.mpo", two_colours_mpo({red}));
  expect_error(ErrorKind::bad_input, "one.mpo: holds one view, expected two or more",
               [&] { read_views(folder / "one.mpo"); });
  put_bytes(folder / "none.mpo", encode_jpeg(Image<Rgb8>(40, 32, red), 95));
  expect_error(ErrorKind::bad_input, "none.mpo: has no MP index", [&] { read_views(folder / "none.mpo"); });
  std::string broken = two_colours_mpo();
  replace_once(broken, std::string("\xB0\x01\0\4\0\0\0\1\0\0\0\2", 12),
               std::string("\xB0\x01\0\4\0\0\0\1\0\0\0\3", 12));
  put_bytes(folder / "broken.mpo", broken);
  expect_error(ErrorKind::bad_input, "broken.mpo: its MP index is damaged", [&] { read_views(folder / "broken.mpo"); });
  put_bytes(folder / "whole.mpo", two_colours_mpo());
  expect_error(ErrorKind::wrong_usage, "contains 2 pictures",
               [&] { read_views(folder / "whole.mpo", {.layout = StereoLayout::left_right}); });
}

TEST(ReadViews, OfAnMpoOfTwoSizesAreRefused) {
  const TemporaryFolder folder;
  const std::string jpegs[] = {encode_jpeg(Image<Rgb8>(40, 32, red), 95), encode_jpeg(Image<Rgb8>(42, 32, blue), 95)};
  put_bytes(folder / "a.mpo", join_multi_pictures(jpegs));
  expect_error(ErrorKind::bad_input, "40x32 and 42x32", [&] { read_views(folder / "a.mpo"); });
}

// What telephones leave: a photograph with its gain map, half the size, type undefined.
TEST(ReadViews, OfAPhotographWithAGainMapAreNone) {
  const TemporaryFolder folder;
  const std::string jpegs[] = {encode_jpeg(still_for_test(160, 120).left, 95),
                               encode_jpeg(Image<Rgb8>(80, 60, red), 95)};
  std::string bytes = join_multi_pictures(jpegs);
  replace_once(bytes, std::string("\x20\x02\0\x02", 4), std::string("\x20\x03\0\0", 4));
  replace_once(bytes, std::string("\0\x02\0\x02", 4), std::string("\0\0\0\0", 4));
  put_bytes(folder / "a.jpg", bytes);
  EXPECT_FALSE(find_views(folder / "a.jpg"));
  EXPECT_TRUE(find_views(folder / "a.jpg", {.layout = StereoLayout::left_right}));
}

TEST(ReadViews, OfAJpsWithoutADescriptorAreCrossEyed) {
  const TemporaryFolder folder;
  write_image(folder / "a.jpg", joined(Image<Rgb8>(40, 32, red), Image<Rgb8>(40, 32, blue), true));
  std::filesystem::rename(folder / "a.jpg", folder / "a.JPS");
  const ViewsFile file = read_views(folder / "a.JPS");
  EXPECT_TRUE(is_like(file.views[0], blue));
  EXPECT_EQ(file.layout, StereoLayout::right_left);
  EXPECT_EQ(file.kind, "JPS");
}

TEST(ReadViews, OfAJpsThatIsNoPairAreRefused) {
  const TemporaryFolder folder;
  write_jps(folder / "a.jps", Image<Rgb8>(40, 32, red), Image<Rgb8>(40, 32, blue));
  const std::string bytes = bytes_of(folder / "a.jps");
  const std::string block("_JPSJPS_\0\4\0\0\2\1", 14);
  const auto with = [&](const std::string& other) {
    std::string changed = bytes;
    replace_once(changed, block, "_JPSJPS_" + other);
    put_bytes(folder / "a.jps", changed);
  };
  with(std::string("\0\4\0\0\4\1", 6));
  expect_error(ErrorKind::bad_input, "an anaglyph", [&] { read_views(folder / "a.jps"); });
  with(std::string("\0\4\0\0\1\1", 6));
  expect_error(ErrorKind::bad_input, "interleaved", [&] { read_views(folder / "a.jps"); });
  with(std::string("\0\4\0\0\2\0", 6));
  expect_error(ErrorKind::bad_input, "one eye only", [&] { read_views(folder / "a.jps"); });
  with(std::string("\0\4\0\0\7\1", 6));
  expect_error(ErrorKind::bad_input, "layout 7", [&] { read_views(folder / "a.jps"); });
}

/// A PNG with the chunk sTER behind its header.
void put_stereo_png(const std::filesystem::path& path, const Image<Rgb8>& picture, char mode) {
  write_image(path, picture);
  std::string bytes = bytes_of(path);
  std::string chunk = std::string("\0\0\0\1sTER", 8) + mode;
  const uLong check = crc32(0, reinterpret_cast<const Bytef*>(chunk.data() + 4), 5);
  for (int i = 3; i >= 0; --i) chunk += static_cast<char>(check >> (8 * i));
  bytes.insert(33, chunk);
  put_bytes(path, bytes);
}

TEST(ReadViews, OfAPngFollowItsStereoChunk) {
  const TemporaryFolder folder;
  for (const int width : {30, 32, 33, 40}) {
    SCOPED_TRACE(width);
    // The right picture begins at a multiple of eight columns.
    const int second = (width + 7) / 8 * 8;
    Image<Rgb8> both(second + width, 20);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < width; ++x) both(x, y) = red, both(second + x, y) = blue;
    }
    put_stereo_png(folder / "a.png", both, 1);
    const ViewsFile file = read_views(folder / "a.png");
    EXPECT_EQ(file.views[0], Image<Rgb8>(width, 20, red));
    EXPECT_EQ(file.views[1], Image<Rgb8>(width, 20, blue));
    EXPECT_EQ(file.how_known, HowKnown::metadata);
    put_stereo_png(folder / "a.png", both, 0);
    EXPECT_EQ(read_views(folder / "a.png").views[0], Image<Rgb8>(width, 20, blue));
  }
}

TEST(ReadViews, AreFoundByLayoutNameAndHalvesInThisOrder) {
  const TemporaryFolder folder;
  const StereoPair pair = still_for_test();
  write_image(folder / "still.png", joined(pair.left, pair.right, true));
  write_image(folder / "still_rl.tif", joined(pair.left, pair.right, true));
  write_image(folder / "above.webp", joined(pair.left, pair.right, false));
  ViewsFile file = read_views(folder / "still.png");
  EXPECT_EQ(file.views[0], pair.left);
  EXPECT_EQ(file.views[1], pair.right);
  EXPECT_EQ(describe_views(file), "side by side, left eye left (from comparing its halves)");
  file = read_views(folder / "still_rl.tif");
  EXPECT_EQ(file.views[1], pair.left);
  EXPECT_EQ(describe_views(file), "side by side, right eye left (from its name)");
  file = read_views(folder / "still_rl.tif", {.layout = StereoLayout::left_right});
  EXPECT_EQ(file.views[0], pair.left);
  EXPECT_EQ(file.how_known, HowKnown::given);
  file = read_views(folder / "above.webp");
  EXPECT_EQ(file.layout, StereoLayout::top_bottom);
  EXPECT_EQ(file.views[1].height(), 360);
  if (const auto teddy = shared_pair("teddy")) {
    write_image(folder / "teddy.png", joined(teddy->left, teddy->right, true));
    file = read_views(folder / "teddy.png");
    EXPECT_EQ(file.views[0], teddy->left);
    EXPECT_EQ(file.views[1], teddy->right);
  }
}

TEST(ReadViews, OfOneOrdinaryPictureAreRefused) {
  const TemporaryFolder folder;
  write_image(folder / "mono.png", still_for_test().left);
  EXPECT_FALSE(find_views(folder / "mono.png"));
  expect_error(ErrorKind::bad_input, "mono.png: is one picture", [&] { read_views(folder / "mono.png"); });
  expect_error(ErrorKind::bad_input, "missing.png: no such file", [&] { read_views(folder / "missing.png"); });
  write_image(folder / "odd_sbs.png", Image<Rgb8>(41, 21));
  expect_error(ErrorKind::bad_input, "odd_sbs.png: is 41x21 pixels, expected an even width",
               [&] { read_views(folder / "odd_sbs.png"); });
  expect_error(ErrorKind::bad_input, "even height",
               [&] { read_views(folder / "odd_sbs.png", {.layout = StereoLayout::top_bottom}); });
}

TEST(ReadViews, AreTurnedUpright) {
  // Two JPEGs that lie on their side.
  const TemporaryFolder folder;
  std::vector<std::string> jpegs;
  for (const Rgb8 colour : {red, blue}) {
    OIIO::ImageSpec spec(40, 32, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Orientation", 6);
    const Image<Rgb8> picture(40, 32, colour);
    const auto output = OIIO::ImageOutput::create("a.jpg");
    ASSERT_TRUE(output->open(folder / "a.jpg", spec) &&
                output->write_image(OIIO::TypeDesc::UINT8, picture.pixels().data()) && output->close());
    jpegs.push_back(bytes_of(folder / "a.jpg"));
  }
  put_bytes(folder / "a.mpo", join_multi_pictures(jpegs));
  EXPECT_EQ(read_views(folder / "a.mpo").views[1].width(), 32);
  EXPECT_EQ(read_views(folder / "a.mpo").views[1].height(), 40);
}

TEST(ReadViews, OfAHeicAreItsTwoPictures) {
  const TemporaryFolder folder;
  if (!put_heic(folder / "a.heic", {{red}, {blue}})) GTEST_SKIP() << "no HEVC encoder";
  const ViewsFile file = read_views(folder / "a.heic");
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_TRUE(is_like(file.views[0], red));
  EXPECT_NE(file.note, "");
  put_heic(folder / "b.heic", {{red}, {blue, 64, 72}});
  expect_error(ErrorKind::bad_input, "does not report which are a stereo pair", [&] { read_views(folder / "b.heic"); });
  put_heic(folder / "c.heic", {{red}});
  expect_error(ErrorKind::bad_input, "c.heic: is one picture", [&] { read_views(folder / "c.heic"); });
  EXPECT_EQ(read_views(folder / "c.heic", {.layout = StereoLayout::top_bottom}).views[0].height(), 32);
}

}  // namespace
}  // namespace wheatstone
