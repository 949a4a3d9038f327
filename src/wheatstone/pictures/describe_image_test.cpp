#include "wheatstone/pictures/read_image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::describe_image_test {

TEST(DescribeImage, TellsWhatIsStored) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(5, 3, 4, OIIO::TypeDesc::UINT16);
  spec.attribute("Orientation", 6);
  const auto output = OIIO::ImageOutput::create("a.tif");
  ASSERT_TRUE(output->open(folder / "a.tif", spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT16, std::vector<std::uint16_t>(60).data()) && output->close());
  const ImageDescription found = describe_image(folder / "a.tif");
  EXPECT_EQ(found.format, "tiff");
  EXPECT_EQ(found.width, 5);
  EXPECT_EQ(found.height, 3);
  EXPECT_EQ(found.channels, 4);
  EXPECT_TRUE(found.has_alpha);
  EXPECT_EQ(found.bits, 16);
  EXPECT_FALSE(found.is_float);
  EXPECT_EQ(found.orientation, 6);
}

TEST(DescribeImage, RefusesWhatIsNoPicture) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.png", "no picture at all");
  expect_error(ErrorKind::bad_input, "a.png: not a picture", [&] { describe_image(folder / "a.png"); });
}

}  // namespace wheatstone::describe_image_test
