#include "wheatstone/image/image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/image/reduced_view.h"

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

TEST(ReducedView, APixelOfSeveralSurfacesIsOfTheFarthestThatIsWanted) {
  constexpr Rgb8 near_colour{200, 0, 0}, far_colour{0, 0, 100};
  Image<Rgb8> photograph(6, 2, far_colour);
  Image<float> disparity(6, 2, 4.f);
  for (int y = 0; y < 2; ++y) {
    for (const int x : {2, 4}) {
      photograph(x, y) = near_colour;
      disparity(x, y) = 12;
    }
  }
  Image<std::uint8_t> seeds(6, 2);
  seeds(4, 1) = seeds(2, 0) = seeds(2, 1) = seeds(3, 0) = 255;
  const ReducedView half = reduced(photograph, disparity, seeds, 2);
  EXPECT_EQ(half.disparity(0, 0), 2);
  EXPECT_EQ(half.disparity(1, 0), 2) << "the first pixel is near";
  EXPECT_EQ(half.photograph(1, 0), far_colour) << "not mixed";
  EXPECT_EQ(half.disparity(2, 0), 6) << "only the near pixel is wanted";
  EXPECT_EQ(half.photograph(2, 0), near_colour);
  EXPECT_EQ(half.seeds(2, 0), 255);
  ASSERT_EQ(half.left_out.size(), 1u) << "the near column that is wanted beside the far one";
  EXPECT_EQ(half.left_out[0].x, 2.5f);
  EXPECT_EQ(half.left_out[0].y, 1.f);
  EXPECT_EQ(half.left_out[0].disparity, 12);
  EXPECT_EQ(half.left_out[0].colour, near_colour);
}

TEST(ReducedView, LeavesOutWhatMakesNoWholePixel) {
  const Image<Rgb8> photograph(5, 3, Rgb8{1, 2, 3});
  const Image<float> disparity(5, 3, -4.f);
  Image<std::uint8_t> seeds(5, 3, 255);
  seeds(4, 0) = 0;
  const ReducedView half = reduced(photograph, disparity, seeds, 2);
  EXPECT_EQ(half.photograph.width(), 2);
  EXPECT_EQ(half.photograph.height(), 1);
  std::vector<std::pair<float, float>> places;
  for (const ReducedView::LeftOut& pixels : half.left_out) {
    EXPECT_EQ(pixels.disparity, -4);
    EXPECT_EQ(pixels.colour, photograph(0, 0));
    places.emplace_back(pixels.x, pixels.y);
  }
  const std::vector<std::pair<float, float>> expected{{4.5f, 1.5f}, {1, 2.5f}, {3, 2.5f}, {4.5f, 2.5f}};
  EXPECT_EQ(places, expected);
}

}  // namespace wheatstone::image_test
