
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/disparity_file.h"

namespace wheatstone::depth_file_test {

constexpr int width = 6, height = 4;

/// A picture of equal or different channels, whose first pixel has `first` of white.
void put_picture(const std::string& path, int channels, OIIO::TypeDesc type, bool colour = false) {
  std::vector<float> values;
  for (int i = 0; i < width * height; ++i)
    for (int c = 0; c < channels; ++c) values.push_back(i == 0 ? 1.f : colour && c == 0 ? 0.9f : 0.2f);
  const auto output = OIIO::ImageOutput::create(path);
  ASSERT_TRUE(output->open(path, OIIO::ImageSpec(width, height, channels, type)));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
}

TEST(DepthFile, IsReadAsItIsStored) {
  const TemporaryFolder folder;
  put_picture(folder / "8.png", 1, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(read_depth(folder / "8.png")(0, 0), 255);
  EXPECT_EQ(read_depth(folder / "8.png")(1, 0), 51);
  put_picture(folder / "16.png", 1, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(read_depth(folder / "16.png")(0, 0), 65535);
  put_picture(folder / "grey.png", 3, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(read_depth(folder / "grey.png")(1, 0), 51);
  Image<float> floats(width, height, 3.5f);
  floats(2, 1) = std::numeric_limits<float>::infinity();
  for (const std::string name : {"a.pfm", "a.exr"}) {
    write_disparity(folder / name, floats);
    EXPECT_EQ(read_depth(folder / name)(1, 1), 3.5f) << name;
    EXPECT_TRUE(std::isnan(read_depth(folder / name)(2, 1))) << name;
  }
}

TEST(DepthFile, InColourOrWithNothingInItIsRefused) {
  const TemporaryFolder folder;
  put_picture(folder / "colour.png", 3, OIIO::TypeDesc::UINT8, true);
  expect_error(ErrorKind::bad_input, "colour.png: is in colour", [&] { read_depth(folder / "colour.png"); });
  write_disparity(folder / "nothing.pfm", Image<float>(width, height, std::numeric_limits<float>::quiet_NaN()));
  expect_error(ErrorKind::bad_input, "nothing.pfm: the depth is unknown everywhere",
               [&] { read_depth(folder / "nothing.pfm"); });
  expect_error(ErrorKind::bad_input, "none.png: no such file", [&] { read_depth(folder / "none.png"); });
  put_bytes(folder / "text.png", "not a picture");
  expect_error(ErrorKind::bad_input, "text.png: is not a depth map", [&] { read_depth(folder / "text.png"); });
}

}  // namespace wheatstone::depth_file_test
