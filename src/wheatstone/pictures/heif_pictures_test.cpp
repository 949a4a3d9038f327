#include "wheatstone/pictures/heif_pictures.h"

#include <gtest/gtest.h>

#include "scenes/heif_pictures.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::heif_pictures_test {

TEST(HeifPictures, AreReadInTheOrderOfTheFile) {
  const TemporaryFolder folder;
  if (!put_heic(folder / "two.heic", {{{200, 40, 30}}, {{30, 60, 210}}})) GTEST_SKIP() << "no HEVC encoder";
  const auto pictures = read_heif_pictures(folder / "two.heic");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_NEAR(pictures[0].picture(5, 5).r, 200, 6);
  EXPECT_NEAR(pictures[1].picture(5, 5).b, 210, 6);
  EXPECT_EQ(pictures[0].picture.width(), 64);
}

TEST(HeifPictures, CutShortAreRefused) {
  const TemporaryFolder folder;
  if (!put_heic(folder / "a.heic", {{{200, 40, 30}}})) GTEST_SKIP() << "no HEVC encoder";
  const std::string bytes = bytes_of(folder / "a.heic");
  for (std::size_t length = 0; length < bytes.size(); length += 5) {
    put_bytes(folder / "a.heic", std::string_view(bytes).substr(0, length));
    expect_error(ErrorKind::bad_input, "a.heic", [&] { read_heif_pictures(folder / "a.heic"); });
  }
}

}  // namespace wheatstone::heif_pictures_test
