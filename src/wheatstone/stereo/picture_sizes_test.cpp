// Smaller copies of large pictures.

#include "wheatstone/stereo/picture_sizes.h"

#include <gtest/gtest.h>

namespace wheatstone::picture_sizes_test {

TEST(ReducedPair, LongerSideIsAsAskedForAndTheAspectStays) {
  const PictureSize wide = reduced_size({12000, 9000}, 2000);
  EXPECT_EQ(wide.width, 2000);
  EXPECT_EQ(wide.height, 1500);
  EXPECT_EQ(reduced_size({9000, 12000}, 2000).width, 1500);
  EXPECT_EQ(reduced_size({1000, 1}, 10).height, 1);
}

TEST(ReducedPair, SmallerPicturesStayAsTheyAre) {
  EXPECT_EQ(reduced_size({640, 480}, 640).width, 640);
  EXPECT_EQ(reduced_size({640, 480}, 2000).height, 480);
}

TEST(ReducedPair, PixelIsTheMeanOfItsArea) {
  Image<Rgb8> picture(4, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) picture(x, y) = {static_cast<std::uint8_t>(x < 2 ? 40 * y : 100), 0, 200};
  const Image<Rgb8> small = reduced(picture, {2, 1});
  EXPECT_EQ(small(0, 0), (Rgb8{20, 0, 200}));
  EXPECT_EQ(small(1, 0), (Rgb8{100, 0, 200}));
}

}  // namespace wheatstone::picture_sizes_test
