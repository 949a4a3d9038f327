#include "wheatstone/photograph/read_views.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/colour_profiles.h"
#include "scenes/heif_pictures.h"
#include "scenes/test_photographs.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/photograph/multi_picture_internal.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::read_views_test {

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

void expect_cut_mpo_refused(std::size_t step) {
  const TemporaryFolder folder;
  const std::string bytes = two_colours_mpo();
  for (std::size_t length = 0; length < bytes.size(); length += step) {
    put_bytes(folder / "a.mpo", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "a.mpo: ", [&] { read_views(folder / "a.mpo"); });
  }
}

TEST(ReadViews, OfAnMpoCutAnywhereAreRefused) { expect_cut_mpo_refused(5); }
TEST(ReadViewsLong, OfAnMpoCutAtAnyByteAreRefused) { expect_cut_mpo_refused(1); }

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
  // A JPEG is looked at in a small copy first.
  write_image(folder / "above.jpg", joined(pair.left, pair.right, false));
  EXPECT_EQ(read_views(folder / "above.jpg").layout, StereoLayout::top_bottom);
  write_image(folder / "crossed.jpg", joined(pair.right, pair.left, true));
  EXPECT_EQ(read_views(folder / "crossed.jpg").layout, StereoLayout::right_left);
  if (const auto teddy = shared_pair("teddy")) {
    write_image(folder / "teddy.png", joined(teddy->left, teddy->right, true));
    file = read_views(folder / "teddy.png");
    EXPECT_EQ(file.views[0], teddy->left);
    EXPECT_EQ(file.views[1], teddy->right);
  }
}

/// Of the left view's pixels that both eyes see, the share whose disparity is off by more than `most_px`.
double share_off_by(const Image<float>& found, const StereoGeometry& truth, float most_px) {
  std::size_t seen = 0, off = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    if (truth.left_occlusion.pixels()[i] != 0) continue;
    ++seen;
    off += !(std::abs(found.pixels()[i] - truth.left_disparity.pixels()[i]) <= most_px);
  }
  return static_cast<double>(off) / static_cast<double>(seen);
}

TEST(ReadViews, OfOneOrdinaryPictureAreRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"mono.png", "mono.jpg"}) {
    write_image(folder / name, still_for_test().left);
    EXPECT_FALSE(find_views(folder / name)) << name;
  }
  expect_error(ErrorKind::bad_input, "mono.png: holds one view", [&] { read_views(folder / "mono.png"); });
  expect_error(ErrorKind::bad_input, "missing.png: no such file", [&] { read_views(folder / "missing.png"); });
  write_image(folder / "line_sbs.png", Image<Rgb8>(1, 21));
  expect_error(ErrorKind::bad_input, "line_sbs.png: is 1x21 pixels, expected an even width",
               [&] { read_views(folder / "line_sbs.png"); });
  expect_error(ErrorKind::bad_input, "mono.png: no two windows of a stereograph card",
               [&] { read_views(folder / "mono.png", options_for_layout("card")); });
}

TEST(ReadViews, OfAnOddNumberOfColumnsOrRowsLeaveOutTheMiddleOne) {
  const StereoPair pair = still_for_test();
  const Image<Rgb8> both = joined(pair.left, pair.right, true), above = joined(pair.left, pair.right, false);
  Image<Rgb8> wide(both.width() + 1, both.height(), {255, 0, 255}),
      high(above.width(), above.height() + 1, {255, 0, 0});
  for (int y = 0; y < both.height(); ++y)
    for (int x = 0; x < both.width(); ++x) wide(x < pair.left.width() ? x : x + 1, y) = both(x, y);
  for (int y = 0; y < above.height(); ++y)
    std::ranges::copy(above.row(y), high.row(y < pair.left.height() ? y : y + 1).begin());
  const TemporaryFolder folder;
  write_image(folder / "wide.png", wide);
  write_image(folder / "high_tbf.png", high);
  for (const auto& [name, middle] : {std::pair{"wide.png", "column"}, std::pair{"high_tbf.png", "row"}}) {
    const ViewsFile file = read_views(folder / name);
    EXPECT_EQ(file.views[0], pair.left) << name;
    EXPECT_EQ(file.views[1], pair.right) << name;
    EXPECT_EQ(file.note, std::string("the middle ") + middle + " belongs to neither view");
  }
}

TEST(ReadViews, OfAnAnimationAreItsTwoFrames) {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& name, const std::vector<Rgb8>& colours) {
    const auto output = OIIO::ImageOutput::create(name);
    const OIIO::ImageSpec spec(40, 32, 3, OIIO::TypeDesc::UINT8);
    const std::vector<OIIO::ImageSpec> specs(colours.size(), spec);
    ASSERT_TRUE(output->open(folder / name, static_cast<int>(specs.size()), specs.data()));
    for (std::size_t i = 0; i < colours.size(); ++i) {
      ASSERT_TRUE(i == 0 || output->open(folder / name, spec, OIIO::ImageOutput::AppendSubimage));
      const Image<Rgb8> picture(40, 32, colours[i]);
      ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, picture.pixels().data()));
    }
    ASSERT_TRUE(output->close());
  };
  put("two.gif", {{255, 0, 0}, {0, 0, 255}});
  const ViewsFile file = read_views(folder / "two.gif");
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_TRUE(is_like(file.views[0], {255, 0, 0}));
  EXPECT_TRUE(is_like(file.views[1], {0, 0, 255}));
  EXPECT_EQ(describe_views(file), "GIF, 2 pictures (from its metadata)");
  EXPECT_EQ(file.note, "the first frame is used for the left eye");
  expect_error(ErrorKind::wrong_usage, "two.gif: contains 2 frames",
               [&] { read_views(folder / "two.gif", {.layout = StereoLayout::left_right}); });
  put("three.gif", {red, blue, red});
  expect_error(ErrorKind::bad_input, "three.gif: has more than two frames, expected two",
               [&] { read_views(folder / "three.gif"); });
  put("one.gif", {red});
  expect_error(ErrorKind::bad_input, "one.gif: holds one view", [&] { read_views(folder / "one.gif"); });
}

/// For red-cyan glasses: the red of the left view and the rest of the right one.
Image<Rgb8> red_cyan_anaglyph(const StereoPair& pair) {
  Image<Rgb8> anaglyph(pair.left.width(), pair.left.height());
  std::ranges::transform(pair.left.pixels(), pair.right.pixels(), anaglyph.pixels().begin(), [](Rgb8 left, Rgb8 right) {
    return Rgb8{left.r, right.g, right.b};
  });
  return anaglyph;
}

Image<Rgb8> grey_of(const Image<Rgb8>& picture) {
  Image<Rgb8> grey(picture.width(), picture.height());
  std::ranges::transform(picture.pixels(), grey.pixels().begin(), [](Rgb8 c) {
    const auto level = static_cast<std::uint8_t>((30 * c.r + 59 * c.g + 11 * c.b) / 100);
    return Rgb8{level, level, level};
  });
  return grey;
}

TEST(ReadViews, OfAnAnaglyphAreGrey) {
  const TemporaryFolder folder;
  const Image<Rgb8> anaglyph = red_cyan_anaglyph(still_for_test());
  write_image(folder / "glasses.png", anaglyph);
  const ViewsFile file = read_views(folder / "glasses.png", options_for_layout("anaglyph-red-cyan"));
  EXPECT_EQ(describe_views(file), "an anaglyph for red-cyan glasses (given)");
  EXPECT_NE(file.note.find("both are grey"), std::string::npos);
  const Rgb8 source = anaglyph(100, 100);
  const auto mean = static_cast<std::uint8_t>((source.g + source.b + 1) / 2);
  EXPECT_EQ(file.views[0](100, 100), (Rgb8{source.r, source.r, source.r}));
  EXPECT_EQ(file.views[1](100, 100), (Rgb8{mean, mean, mean}));
  const ViewsFile other = read_views(folder / "glasses.png", options_for_layout("anaglyph-amber-blue"));
  EXPECT_EQ(other.views[1](100, 100), (Rgb8{source.b, source.b, source.b}));
}

TEST(ReadViews, OfAnAnaglyphCanBeMatched) {
  const SyntheticStill still = make_synthetic_still({.width = 480, .height = 360, .samples_a_side = 1});
  const TemporaryFolder folder;
  // As printed in black and white, and in colour, where what is red is bright for one eye and dark for the other.
  const StereoPair grey{grey_of(still.pictures.left), grey_of(still.pictures.right)};
  for (const auto& [pair, most] : {std::pair{grey, 0.05}, std::pair{still.pictures, 0.31}}) {
    write_image(folder / "glasses.png", red_cyan_anaglyph(pair));
    const ViewsFile file = read_views(folder / "glasses.png", options_for_layout("anaglyph-red-cyan"));
    const Image<float> found = match({file.views[0], file.views[1]}, {}).geometry.left_disparity;
    EXPECT_LT(share_off_by(found, still.geometry, 2), most);
  }
}

TEST(ReadViews, KnowTheirLayoutsByName) {
  for (const std::string_view name : photograph_layout_names()) {
    const ReadViewsOptions options = options_for_layout(name);
    EXPECT_NE(options.layout.has_value(), options.scan.has_value()) << name;
  }
  expect_error(ErrorKind::wrong_usage, "expected one that names the colours of its glasses",
               [] { options_for_layout("anaglyph"); });
  expect_error(ErrorKind::wrong_usage, "left-right (sbsl), left-right-half (sbs2l)",
               [] { options_for_layout("checkers"); });
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
  expect_error(ErrorKind::bad_input, "c.heic: holds one view", [&] { read_views(folder / "c.heic"); });
  EXPECT_EQ(read_views(folder / "c.heic", {.layout = StereoLayout::top_bottom}).views[0].height(), 32);
}

TEST(ReadViews, KeepTheProfileThatTheyShare) {
  const TemporaryFolder folder;
  const std::string wide = display_p3();
  if (!put_heic(folder / "a.heic", {{red, 64, 64, wide}, {blue, 64, 64, wide}})) GTEST_SKIP() << "no HEVC encoder";
  const ViewsFile kept = read_views(folder / "a.heic", {.keep_profile = true}), srgb = read_views(folder / "a.heic");
  EXPECT_EQ(kept.colour_profile, wide);
  EXPECT_EQ(srgb.colour_profile, "");
  EXPECT_GT(srgb.views[0](32, 32).r, kept.views[0](32, 32).r + 8);  // a wider red is a stronger one
  put_heic(folder / "b.heic", {{red, 64, 64, wide}, {blue}});
  const ViewsFile different = read_views(folder / "b.heic", {.keep_profile = true});
  EXPECT_EQ(different.colour_profile, "");
  EXPECT_EQ(different.views[0], srgb.views[0]);
}

}  // namespace wheatstone::read_views_test
