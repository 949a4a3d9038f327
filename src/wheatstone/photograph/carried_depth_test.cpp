#include "wheatstone/photograph/carried_depth.h"

#include <gtest/gtest.h>
#include <libheif/heif.h>

#include <algorithm>
#include <cmath>

#include "scenes/heif_pictures.h"
#include "scenes/test_photographs.h"
#include "scenes/xmp_pictures.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::carried_depth_test {

constexpr int width = 64, height = 48;
constexpr Rgb8 red{200, 30, 30}, blue{30, 30, 200};

/// Level 0 above, 255 below.
Image<Rgb8> level_map(int map_width = width, int map_height = height) {
  Image<Rgb8> map(map_width, map_height);
  for (int y = map_height / 2; y < map_height; ++y) std::ranges::fill(map.row(y), Rgb8{255, 255, 255});
  return map;
}

std::string photograph() { return encode_jpeg(Image<Rgb8>(width, height, red), 95); }

std::string with_depth(const std::string& attributes, std::string_view map) {
  return with_extended_data(photograph(), attributes, "GDepth:Data", map, 500);
}

TEST(CarriedDepth, OfGoogleIsReadInBothItsFormats) {
  const TemporaryFolder folder;
  const std::string map = encode_jpeg(level_map(), 95);
  put_bytes(folder / "inverse.jpg", with_depth(R"(GDepth:Format="RangeInverse" GDepth:Near="1" GDepth:Far="9")", map));
  std::optional<CarriedDepth> found = find_carried_depth(folder / "inverse.jpg");
  ASSERT_TRUE(found);
  EXPECT_TRUE(carries_depth(folder / "inverse.jpg"));
  EXPECT_EQ(found->kind, DepthKind::inverse);
  EXPECT_EQ(found->picture.width(), width);
  // Level 0 is the nearest point, and nearer is larger.
  EXPECT_NEAR(found->depth(9, 2), 1, 0.02);
  EXPECT_NEAR(found->depth(9, height - 2), 0, 0.02);

  write_image(folder / "map.png", level_map());
  put_bytes(folder / "linear.jpg", with_depth(R"(GDepth:Format="RangeLinear" GDepth:Near="1.5" GDepth:Far="9")",
                                              bytes_of(folder / "map.png")));
  found = find_carried_depth(folder / "linear.jpg");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, DepthKind::metric);
  EXPECT_NEAR(found->depth(9, 2), 1.5, 0.05);
  EXPECT_NEAR(found->depth(9, height - 2), 9, 0.05);
}

TEST(CarriedDepth, OfDynamicDepthStandsBehindThePicture) {
  const TemporaryFolder folder;
  const std::string map = encode_jpeg(level_map(), 95), other = "another item";
  const auto item = [](const std::string& semantic, std::size_t length) {
    return "<rdf:li><Container:Item Item:Semantic=\"" + semantic + "\" Item:Length=\"" + std::to_string(length) +
           "\"/></rdf:li>";
  };
  const auto file = [&](std::size_t length) {
    return with_segments(photograph(),
                         packet_segment("DepthMap:Format=\"RangeInverse\"", item("Primary", 0) + item("Depth", length) +
                                                                                item("Confidence", other.size()))) +
           map + other;
  };
  put_bytes(folder / "a.jpg", file(map.size()));
  const std::optional<CarriedDepth> found = find_carried_depth(folder / "a.jpg");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->depth(9, 2), 1, 0.02);
  put_bytes(folder / "b.jpg", file(1000000));
  expect_error(ErrorKind::bad_input, "more bytes than the file has", [&] { find_carried_depth(folder / "b.jpg"); });
  put_bytes(folder / "c.jpg", file(map.size() - 9));
  expect_error(ErrorKind::bad_input, "c.jpg", [&] { find_carried_depth(folder / "c.jpg"); });
}

TEST(CarriedDepth, TurnsWithItsPicture) {
  const TemporaryFolder folder;
  // EXIF: orientation 6, to be turned by 90 degrees clockwise: what is stored below stands on the left.
  const std::string exif("Exif\0\0II\x2A\0\x8\0\0\0\1\0\x12\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0", 32);
  const std::string jpeg = with_depth("GDepth:Format=\"RangeInverse\"", encode_jpeg(level_map(), 95));
  put_bytes(folder / "a.jpg", with_segments(jpeg, app1_segment(exif)));
  const std::optional<CarriedDepth> found = find_carried_depth(folder / "a.jpg");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->picture.width(), height);
  ASSERT_EQ(found->depth.width(), height);
  EXPECT_NEAR(found->depth(2, 9), 0, 0.02);
  EXPECT_NEAR(found->depth(height - 2, 9), 1, 0.02);
}

TEST(CarriedDepth, ThatIsDamagedIsRefused) {
  const TemporaryFolder folder;
  const std::string map = encode_jpeg(level_map(), 95), inverse = "GDepth:Format=\"RangeInverse\"";
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    put_bytes(folder / "a.jpg", bytes);
    expect_error(ErrorKind::bad_input, part, [&] { find_carried_depth(folder / "a.jpg"); });
  };
  refused(with_depth("GDepth:Format=\"Waves\"", map), "a.jpg: its depth map has the format 'Waves'");
  refused(with_depth("GDepth:Format=\"RangeLinear\"", map), "no number for Near");
  refused(with_depth(R"(GDepth:Format="RangeLinear" GDepth:Near="5" GDepth:Far="2")", map), "between 5 and 2");
  refused(with_depth(inverse, map.substr(0, map.size() / 2)), "ends too early");
  refused(with_depth(inverse, "text"), "neither PNG nor JPEG");
  refused(with_segments(photograph(), packet_segment(inverse + " GDepth:Data=\"*\"")), "not base64");
  put_bytes(folder / "none.jpg", photograph());
  EXPECT_FALSE(find_carried_depth(folder / "none.jpg"));
  EXPECT_FALSE(carries_depth(folder / "none.jpg"));
  EXPECT_FALSE(carries_depth(folder / "there is no such.jpg"));
}

/// Writes a HEIC file whose picture has a depth image: its alpha image, under another name. False where no encoder is
/// installed.
bool put_portrait(const std::filesystem::path& path) {
  const auto with_alpha = [](std::size_t) {
    return make_heif_image(width, height, heif_chroma_interleaved_RGBA, [](int y, std::uint8_t* row) {
      const std::array<std::uint8_t, 4> pixel{red.r, red.g, red.b,
                                              static_cast<std::uint8_t>(y < height / 2 ? 20 : 220)};
      for (int x = 0; x < width; ++x) std::ranges::copy(pixel, row + 4 * static_cast<std::ptrdiff_t>(x));
    });
  };
  if (!write_heic(path, 1, with_alpha)) return false;

  std::string bytes = bytes_of(path);
  const std::string alpha = "urn:mpeg:hevc:2015:auxid:1";
  const std::size_t at = bytes.find(alpha);
  if (at == std::string::npos) return false;
  bytes[at + alpha.size() - 1] = '2';
  put_bytes(path, bytes);
  return true;
}

TEST(CarriedDepth, OfAHeicPortraitIsItsDepthImage) {
  const TemporaryFolder folder;
  if (!put_portrait(folder / "portrait.heic")) GTEST_SKIP() << "no HEVC encoder";
  const std::optional<CarriedDepth> found = find_carried_depth(folder / "portrait.heic");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, DepthKind::inverse);
  EXPECT_EQ(found->picture.width(), width);
  EXPECT_EQ(found->depth.width(), width);
  EXPECT_NEAR(found->depth(9, 4), 20 / 255., 0.02);
  EXPECT_NEAR(found->depth(9, height - 4), 220 / 255., 0.02);
  put_heic(folder / "plain.heic", {{red}});
  EXPECT_FALSE(find_carried_depth(folder / "plain.heic"));
}

TEST(CarriedDepth, BesideThePictureIsItsRightHalf) {
  const TemporaryFolder folder;
  Image<Rgb8> both(2 * width, height, red);
  for (int y = 0; y < height; ++y)
    for (int x = width; x < 2 * width; ++x) both(x, y) = level_map()(x - width, y);
  write_image(folder / "rgbd.png", both);
  const CarriedDepth read = read_depth_beside(folder / "rgbd.png");
  EXPECT_EQ(read.picture, Image<Rgb8>(width, height, red));
  EXPECT_EQ(read.depth(5, 1), 0);
  EXPECT_EQ(read.depth(5, height - 1), 255);
  write_image(folder / "two.png", Image<Rgb8>(2 * width, height, red));
  expect_error(ErrorKind::bad_input, "two.png: its right half is in colour",
               [&] { read_depth_beside(folder / "two.png"); });
  write_image(folder / "odd.png", Image<Rgb8>(2 * width + 1, height));
  expect_error(ErrorKind::bad_input, "odd.png: is 129 pixels wide", [&] { read_depth_beside(folder / "odd.png"); });
}

TEST(CarriedDepth, BesideAPhotographIsRecognised) {
  const TemporaryFolder folder;
  const SyntheticStill still = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1});
  const Image<Rgb8>& left = still.pictures.left;
  Image<Rgb8> depth(240, 180), grey(240, 180);
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) {
      const auto level = static_cast<std::uint8_t>(std::clamp(4 * still.geometry.left_disparity(x, y), 0.f, 255.f));
      depth(x, y) = {level, level, level};
      grey(x, y) = {left(x, y).g, left(x, y).g, left(x, y).g};
    }
  for (const char* name : {"found.png", "found.jpg"}) {
    write_image(folder / name, joined(left, depth, true));
    ASSERT_TRUE(carries_depth(folder / name)) << name;
    const std::optional<CarriedDepth> found = find_carried_depth(folder / name);
    EXPECT_EQ(found->how, "its right half");
    EXPECT_EQ(found->picture.width(), 240);
    EXPECT_NEAR(found->depth(120, 90), depth(120, 90).g, 4);
  }
  // Neither two views, nor a photograph beside itself in grey, nor beside the depth of another.
  Image<Rgb8> other(240, 180);
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) other(x, y) = depth(239 - x, y);
  write_image(folder / "views.png", joined(left, still.pictures.right, true));
  write_image(folder / "copy.png", joined(left, grey, true));
  write_image(folder / "other.png", joined(left, other, true));
  write_image(folder / "views.jpg", joined(left, still.pictures.right, true));
  for (const char* name : {"views.png", "views.jpg", "copy.png", "other.png"})
    EXPECT_FALSE(carries_depth(folder / name)) << name;
  // The name is believed of a grey photograph.
  write_image(folder / "old_rgbd.png", joined(grey, depth, true));
  write_image(folder / "old.png", joined(grey, depth, true));
  EXPECT_TRUE(carries_depth(folder / "old_rgbd.png"));
  EXPECT_FALSE(carries_depth(folder / "old.png"));
}

TEST(ReadViews, OfAVrPhotographAreThePictureAndThatInItsXmp) {
  const TemporaryFolder folder;
  const std::string right = encode_jpeg(Image<Rgb8>(width, height, blue), 95);
  put_bytes(folder / "a.vr.jpg",
            with_extended_data(photograph(), "GImage:Mime=\"image/jpeg\"", "GImage:Data", right, 500));
  const ViewsFile file = read_views(folder / "a.vr.jpg");
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_GT(file.views[0](5, 5).r, 150);
  EXPECT_GT(file.views[1](5, 5).b, 150);
  EXPECT_EQ(describe_views(file), "VR photograph, 2 pictures (from its metadata)");
  EXPECT_FALSE(carries_depth(folder / "a.vr.jpg"));
  const std::string small = encode_jpeg(Image<Rgb8>(32, 32, blue), 95);
  put_bytes(folder / "b.jpg", with_extended_data(photograph(), "GImage:Mime=\"image/jpeg\"", "GImage:Data", small));
  expect_error(ErrorKind::bad_input, "64x48 and 32x32", [&] { read_views(folder / "b.jpg"); });
  put_bytes(folder / "c.jpg", with_extended_data(photograph(), "GImage:Mime=\"image/jpeg\"", "GImage:Data", "text"));
  expect_error(ErrorKind::bad_input, "c.jpg: the right eye's picture", [&] { read_views(folder / "c.jpg"); });
}

}  // namespace wheatstone::carried_depth_test
