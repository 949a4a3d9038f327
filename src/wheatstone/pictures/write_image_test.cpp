#include "wheatstone/pictures/write_image.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::write_image_test {

namespace fs = std::filesystem;

Image<Rgb8> ramp(int width, int height) {
  Image<Rgb8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = {static_cast<std::uint8_t>(5 * x), static_cast<std::uint8_t>(7 * y), 90};
    }
  }
  return image;
}

TEST(WriteImage, IsReadBackTheSameFromLosslessFormats) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.tif", "a.ppm", "a.bmp", "A.PNG"}) {
    write_image(folder / name, ramp(31, 17));
    EXPECT_EQ(read_image(folder / name), ramp(31, 17)) << name;
  }
}

TEST(WriteImage, IsReadBackNearlyTheSameFromLossyFormats) {
  const TemporaryFolder folder;
  for (const char* name : {"a.jpg", "a.webp"}) {
    write_image(folder / name, ramp(32, 24));
    const Image<Rgb8> found = read_image(folder / name);
    ASSERT_TRUE(same_size(found, ramp(32, 24)));
    int worst = 0;
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) worst = std::max(worst, std::abs(found(x, y).r - 5 * x));
    }
    EXPECT_LE(worst, 12) << name;
  }
}

TEST(WriteImage, WritesMasksAsGrey) {
  const TemporaryFolder folder;
  Image<std::uint8_t> mask(3, 2, 0);
  mask(2, 1) = 255;
  for (const char* name : {"mask.png", "mask.tif"}) {
    write_image(folder / name, mask);
    EXPECT_EQ(read_image(folder / name)(2, 1), (Rgb8{255, 255, 255})) << name;
    EXPECT_EQ(read_image(folder / name)(1, 1), (Rgb8{0, 0, 0})) << name;
    EXPECT_EQ(describe_image(folder / name).channels, 1) << name;
  }
}

TEST(WriteImage, WritesAPartOfAPicture) {
  const TemporaryFolder folder;
  Image<Rgb8> whole = ramp(10, 8);
  write_image(folder / "part.png", ImageView<const Rgb8>(&whole(3, 2), 4, 5, 10));
  const Image<Rgb8> part = read_image(folder / "part.png");
  ASSERT_EQ(part.width(), 4);
  ASSERT_EQ(part.height(), 5);
  EXPECT_EQ(part(3, 4), whole(6, 6));
}

TEST(WriteImage, WritesTheSameBytesTwice) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.webp"}) {
    write_image(folder / name, ramp(31, 17));
    const std::string first = bytes_of(folder / name);
    write_image(folder / name, ramp(31, 17));
    EXPECT_EQ(bytes_of(folder / name), first) << name;
  }
}

TEST(WriteImage, LeavesNothingBehindWhenItCannot) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::cannot_read_write, "/dev/null/a.png: cannot write",
               [&] { write_image("/dev/null/a.png", ramp(4, 4)); });
  expect_error(ErrorKind::wrong_usage, "a.xyz: unknown picture format",
               [&] { write_image(folder / "a.xyz", ramp(4, 4)); });
  expect_error(ErrorKind::cannot_read_write, "a WebP has at most 16383 pixels",
               [&] { write_image(folder / "a.webp", ramp(16384, 1)); });
  expect_error(ErrorKind::cannot_read_write, "no pixels", [&] { write_image(folder / "a.png", Image<Rgb8>()); });
  EXPECT_TRUE(folder.is_empty());
}

TEST(WriteImage, SaysThatTheDiskIsFull) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.webp", "a.ppm", "a.bmp"}) {
    fs::create_symlink("/dev/full", folder / name);
    expect_error(ErrorKind::cannot_read_write, "No space left", [&] { write_image(folder / name, ramp(4, 4)); });
  }
}

}  // namespace wheatstone::write_image_test
