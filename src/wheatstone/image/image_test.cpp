#include "wheatstone/image/image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::image_test {

Image<int> counted(int width, int height) {
  Image<int> image(width, height);
  int next = 0;
  for (int& value : image.pixels()) value = next++;
  return image;
}

TEST(Image, StandsRowByRowFromTheTop) {
  const Image<int> image = counted(3, 2);
  EXPECT_EQ(image(2, 0), 2);
  EXPECT_EQ(image(0, 1), 3);
  EXPECT_EQ(image.row(1).size(), 3u);
  EXPECT_EQ(image.row(1)[2], 5);
}

TEST(Image, CopiesItsPixels) {
  const Image<int> first = counted(2, 2);
  Image<int> second = first;
  EXPECT_EQ(first, second);
  second(1, 1) = 99;
  EXPECT_EQ(first(1, 1), 3);
  EXPECT_NE(first, second);
}

TEST(Image, OfTheSamePixelsInAnotherShapeDiffers) { EXPECT_NE(counted(3, 2), counted(2, 3)); }

TEST(Image, ContainsItsFirstPixelAndNotTheOneBehindItsLast) {
  const Image<int> image(3, 2);
  EXPECT_TRUE(image.contains(0, 0));
  EXPECT_TRUE(image.contains(2, 1));
  EXPECT_FALSE(image.contains(3, 1));
  EXPECT_FALSE(image.contains(2, 2));
  EXPECT_FALSE(image.contains(-1, 0));
}

TEST(ImageView, OfAPartStepsOverTheRestOfARow) {
  Image<int> image = counted(4, 3);
  const ImageView<int> part(&image(1, 1), 2, 2, 4);
  EXPECT_EQ(part(0, 0), 5);
  EXPECT_EQ(part(1, 1), 10);
  part(1, 1) = -1;
  EXPECT_EQ(image(2, 2), -1);
}

TEST(ImageView, OfAnEmptyImageIsEmpty) {
  const Image<float> image;
  EXPECT_TRUE(image.view().empty());
  EXPECT_TRUE(ImageView<const float>().empty());
}

TEST(OpenCvMatrix, SharesThePixelsOfAPart) {
  Image<float> image(4, 3, 1.0f);
  cv::Mat part = as_mat(ImageView<float>(&image(1, 1), 2, 2, 4));
  part.at<float>(1, 1) = 7;
  EXPECT_EQ(image(2, 2), 7);
  EXPECT_EQ(part.size(), cv::Size(2, 2));
}

}  // namespace wheatstone::image_test
