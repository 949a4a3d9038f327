// What goes with a photograph into pictures that are made of it.

#include "wheatstone/photograph/photograph_notes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scenes/exif_data.h"
#include "scenes/xmp_pictures.h"
#include "temporary_folder.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::photograph_notes_test {

std::string photograph(const std::string& title) {
  return with_notes(encode_jpeg(Image<Rgb8>(64, 48, {90, 120, 60}), 95), {.exif = exif_data(title)});
}

/// Whether some entry of an EXIF block has these bytes.
bool has(const std::string& exif, std::string_view bytes) { return exif.find(bytes) != std::string::npos; }

TEST(PhotographNotes, TravelFromFileToFileWithoutThePlace) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.jpg", photograph("Apples"));
  const PictureNotes notes = read_photograph_notes(folder / "a.jpg");
  EXPECT_EQ(notes.title, "Apples");
  EXPECT_EQ(notes.taken, "2019:07:18 14:03:22");
  EXPECT_TRUE(has(notes.exif, "Maker"));
  EXPECT_FALSE(has(notes.exif, "mmmm"));  // the maker's own notes
  EXPECT_FALSE(has(notes.exif, little(0x8825, 2) + little(4, 2)));
  EXPECT_FALSE(has(notes.exif, std::string("2019:07:18\0", 11)));

  const Image<Rgb8> picture(64, 48, {90, 120, 60});
  const std::vector<ImageView<const Rgb8>> views{picture, picture};
  write_image(folder / "b.jpg", picture, notes);
  write_image(folder / "b.png", picture, notes);
  write_mpo(folder / "b.mpo", views, 95, notes);
  write_jps(folder / "b.jps", picture, picture, StereoLayout::right_left, 95, notes);
  for (const char* name : {"b.jpg", "b.png", "b.mpo", "b.jps"}) {
    const PictureNotes again = read_photograph_notes(folder / name, true);
    EXPECT_EQ(again.title, notes.title) << name;
    EXPECT_EQ(again.taken, notes.taken) << name;
    EXPECT_EQ(again.exif, notes.exif) << name;
  }
  EXPECT_EQ(read_image(folder / "b.png"), picture);
  write_image(folder / "b.tif", picture, notes);
  EXPECT_EQ(read_photograph_notes(folder / "b.tif").title, "Apples");
  EXPECT_EQ(read_photograph_notes(folder / "b.tif").taken, notes.taken);
}

TEST(PhotographNotes, HaveThePlaceWhereThatIsWanted) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.jpg", photograph("Apples"));
  EXPECT_TRUE(has(read_photograph_notes(folder / "a.jpg", true).exif, std::string("2019:07:18\0", 11)));
}

TEST(PhotographNotes, TakeTheTitleThatPeopleGave) {
  const TemporaryFolder folder;
  const auto title_of = [&](const std::string& bytes) {
    put_bytes(folder / "a.jpg", bytes);
    return read_photograph_notes(folder / "a.jpg").title;
  };
  EXPECT_EQ(title_of(photograph("OLYMPUS DIGITAL CAMERA")), "");
  EXPECT_EQ(title_of(photograph("  Gr\xc3\xbc\xc3\x9f"
                                "e\n")),
            "Gr\xc3\xbc\xc3\x9f"
            "e");
  EXPECT_EQ(title_of(photograph("Gr\xfc\xdf"
                                "e")),
            "Gr\xc3\xbc\xc3\x9f"
            "e");  // Latin-1
  EXPECT_EQ(title_of(with_notes(encode_jpeg(Image<Rgb8>(64, 48), 95), {})), "");
  write_image(folder / "a.png", Image<Rgb8>(64, 48), {.title = "Pears & more"});
  EXPECT_EQ(read_photograph_notes(folder / "a.png").title, "Pears & more");
}

TEST(PhotographNotes, ThatAreDamagedAreNone) {
  const TemporaryFolder folder;
  const std::string whole = photograph("Apples"), exif = exif_data("Apples");
  for (std::size_t length = 0; length < exif.size(); length += 7) {
    put_bytes(folder / "a.jpg", with_notes(encode_jpeg(Image<Rgb8>(16, 16), 95), {.exif = exif.substr(0, length)}));
    read_photograph_notes(folder / "a.jpg");
  }
  EXPECT_EQ(read_photograph_notes(folder / "there is no such.jpg").exif, "");
}

TEST(PictureNotes, SayHowManyPixelsAnInchHas) {
  const TemporaryFolder folder;
  const Image<Rgb8> picture(64, 48);
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) write_image(folder / name, picture, {.pixels_an_inch = 600});
  const std::string png = bytes_of(folder / "a.png"), jpeg = bytes_of(folder / "a.jpg");
  EXPECT_NE(png.find(std::string("pHYs\0\0\x5c\x46\0\0\x5c\x46\1", 13)), std::string::npos);  // 23622 a metre
  EXPECT_EQ(jpeg.substr(13, 5), std::string("\1\x02\x58\x02\x58", 5));
  EXPECT_EQ(read_image(folder / "a.png"), picture);
}

}  // namespace wheatstone::photograph_notes_test
