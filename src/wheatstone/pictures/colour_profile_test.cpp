// Profiles as they come in each kind of file; what a known colour becomes is said by the profile's own primaries.

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "scenes/colour_profiles.h"
#include "scenes/heif_pictures.h"
#include "temporary_folder.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/pictures/colour_profile_internal.h"
#include "wheatstone/pictures/heif_pictures.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::colour_profile_test {

void put_with_profile(const std::filesystem::path& path, Rgb8 colour, const std::string& profile) {
  constexpr int side = 16;
  OIIO::ImageSpec spec(side, side, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())), profile.data());
  spec.attribute("Compression", path.extension() == ".jpg" ? "jpeg:100" : "zip");
  const Image<Rgb8> picture(side, side, colour);
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), spec) &&
              output->write_image(OIIO::TypeDesc::UINT8, picture.pixels().data()) && output->close());
}

void expect_near(Rgb8 found, Rgb8 expected, int tolerance) {
  EXPECT_LE(std::abs(found.r - expected.r), tolerance) << int(found.r);
  EXPECT_LE(std::abs(found.g - expected.g), tolerance) << int(found.g);
  EXPECT_LE(std::abs(found.b - expected.b), tolerance) << int(found.b);
}

/// Display P3 to sRGB by the matrix of CSS Color 4, sec. 10.9: an independent way.
Rgb8 srgb_from_p3(Rgb8 colour) {
  const float r = linear_from_srgb(colour.r), g = linear_from_srgb(colour.g), b = linear_from_srgb(colour.b);
  return {srgb_from_linear(1.2249f * r - 0.2247f * g), srgb_from_linear(-0.0420f * r + 1.0419f * g),
          srgb_from_linear(-0.0197f * r - 0.0786f * g + 1.0979f * b)};
}

TEST(ColourProfile, IsBroughtToSrgbInEveryKindOfFile) {
  const TemporaryFolder folder;
  const Rgb8 colour{200, 120, 90};
  const Rgb8 expected = srgb_from_p3(colour);
  ASSERT_GE(std::abs(expected.r - colour.r), 8) << "the colour must be one that the profile moves";
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
    SCOPED_TRACE(name);
    put_with_profile(folder / name, colour, display_p3());
    expect_near(read_image(folder / name)(8, 8), expected, 2);
  }
}

TEST(ColourProfile, MayBeToldByNumbersInAHeic) {
  const TemporaryFolder folder;
  const Rgb8 colour{200, 120, 90};
  constexpr std::uint16_t of_srgb = 1, of_display_p3 = 12;
  if (!put_heic(folder / "a.heic", {{.colour = colour, .primaries = of_display_p3}})) GTEST_SKIP() << "no HEVC encoder";
  expect_near(read_image(folder / "a.heic")(8, 8), srgb_from_p3(colour), 4);
  expect_near(read_heif_pictures(folder / "a.heic")[0].picture(8, 8), colour, 4);
  EXPECT_TRUE(describes_other_colours(read_heif_pictures(folder / "a.heic")[0].colour_profile));
  put_heic(folder / "b.heic", {{.colour = colour, .primaries = of_srgb}});
  expect_near(read_image(folder / "b.heic")(8, 8), colour, 4);
}

TEST(ColourProfile, OfPrimariesSaysNothingOfTheTimeItWasMadeAt) {
  const std::string profile = profile_with_primaries({{{0.68, 0.32}, {0.265, 0.69}, {0.15, 0.06}, {0.3127, 0.329}}});
  EXPECT_TRUE(describes_other_colours(profile));
  EXPECT_EQ(profile.substr(24, 12), std::string("\x07\xd0\0\x01\0\x01\0\0\0\0\0\0", 12));
}

TEST(ColourProfile, OfAWebpIsFound) {
  const TemporaryFolder folder;
  const Rgb8 colour{200, 120, 90};
  put_with_profile(folder / "a.webp", colour, display_p3());
  const Rgb8 plain = read_image(folder / "a.webp")(8, 8);
  // The encoder leaves the profile out: an extended file of its picture and a profile, as others write it.
  const std::string bytes = bytes_of(folder / "a.webp");
  const std::string profile = display_p3();
  const auto little = [](std::size_t number) {
    std::string text;
    for (int i = 0; i < 4; ++i) text += static_cast<char>(number >> (8 * i));
    return text;
  };
  const std::string head = std::string("VP8X") + little(10) + std::string("\x20\0\0\0\x0f\0\0\x0f\0\0", 10);
  const std::string chunk = "ICCP" + little(profile.size()) + profile + std::string(profile.size() % 2, '\0');
  const std::string body = "WEBP" + head + chunk + bytes.substr(12);
  put_bytes(folder / "b.webp", "RIFF" + little(body.size()) + body);
  expect_near(read_image(folder / "b.webp")(8, 8), srgb_from_p3(plain), 2);
}

TEST(ColourProfile, OfSrgbLeavesTheBytesAlone) {
  const TemporaryFolder folder;
  const Rgb8 colour{201, 121, 91};
  put_with_profile(folder / "a.png", colour, saved(cmsCreate_sRGBProfile()));
  EXPECT_EQ(read_image(folder / "a.png")(3, 3), colour);
}

TEST(ColourProfile, OfGreyIsAppliedToGrey) {
  Image<Rgb8> picture(2, 1, {100, 100, 100});
  bring_to_srgb(picture, grey_gamma(1.0), true);
  const auto expected = srgb_from_linear(100 / 255.0f);
  expect_near(picture(1, 0), {expected, expected, expected}, 2);
}

TEST(ColourProfile, ThatIsDamagedOrOfOtherChannelsIsLeftAside) {
  Image<Rgb8> picture(2, 1, {100, 50, 20});
  const Image<Rgb8> before = picture;
  const std::string whole = display_p3();
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    bring_to_srgb(picture, std::string_view(whole).substr(0, length), false);
    ASSERT_EQ(picture, before) << length;
  }
  bring_to_srgb(picture, grey_gamma(1.0), false);
  EXPECT_EQ(picture, before);
  bring_to_srgb(picture, whole, false);
  EXPECT_NE(picture, before);
}

TEST(ColourProfile, IsWrittenIntoEveryFormatThatTakesIt) {
  const TemporaryFolder folder;
  const Rgb8 colour{200, 120, 90};
  const Image<Rgb8> picture(16, 16, colour);
  for (const std::size_t padding : {0, 200'000}) {  // JPEG has it in parts of 64 kB
    PictureNotes notes{.title = "A title"};
    notes.colour_profile = display_p3() + std::string(padding, '\0');
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
      SCOPED_TRACE(name);
      ASSERT_TRUE(takes_profile(name));
      write_image(folder / name, picture, notes);
      const PictureInProfile read = read_in_profile(folder / name);
      EXPECT_EQ(read.colour_profile, notes.colour_profile);
      expect_near(read.picture(8, 8), colour, 1);
      expect_near(read_image(folder / name)(8, 8), srgb_from_p3(colour), 2);
    }
  }
  for (const char* name : {"a.webp", "a.ppm", "a.bmp"}) EXPECT_FALSE(takes_profile(name)) << name;
}

TEST(ColourProfile, StaysWhereAllPicturesShareIt) {
  const Image<Rgb8> picture(2, 2, {200, 120, 90});
  const std::string wide = display_p3(), srgb = saved(cmsCreate_sRGBProfile());
  const auto brought = [&](std::vector<std::string> profiles, bool keep_shared = true) {
    std::vector<PictureInProfile> pictures;
    for (std::string& profile : profiles) pictures.push_back({picture, std::move(profile)});
    const std::string kept = bring_to_one_profile(pictures, keep_shared);
    for (const PictureInProfile& one : pictures) EXPECT_EQ(one.colour_profile, kept);
    return std::pair(kept, std::move(pictures));
  };
  const auto [kept, same] = brought({wide, wide});
  EXPECT_EQ(kept, wide);
  EXPECT_EQ(same[1].picture, picture);
  const auto [none, different] = brought({wide, ""});
  EXPECT_EQ(none, "");
  expect_near(different[0].picture(0, 0), srgb_from_p3({200, 120, 90}), 2);
  EXPECT_EQ(different[1].picture, picture);
  EXPECT_EQ(brought({srgb, srgb}).first, "");
  EXPECT_EQ(brought({wide.substr(0, 90)}).first, "");
  EXPECT_EQ(brought({}).first, "");
  const auto [unwanted, in_srgb] = brought({wide}, false);
  EXPECT_EQ(unwanted, "");
  EXPECT_EQ(in_srgb[0].picture, different[0].picture);
}

}  // namespace wheatstone::colour_profile_test
