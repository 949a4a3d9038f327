#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "scenes/test_photographs.h"
#include "wheatstone/calibration/rectifying_map.h"
#include "wheatstone/calibration/warp_picture_internal.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::warp_picture_test {

TEST(WarpedPicture, IsTheOneWhosePlacesAreWorkedOutPixelByPixel) {
  Image<Rgb8> photograph(1000, 750);
  cv::Mat enlarged = as_mat(photograph);
  cv::resize(as_mat(still_for_test().left), enlarged, enlarged.size(), 0, 0, cv::INTER_CUBIC);
  RectifyingMap map{.width = 1000, .height = 750, .straightening = 0.15};
  map.homography = {1.02, 0.03, -8, -0.02, 0.99, 3, 1e-5, -2e-5, 1};
  map.row_correction = {0.5, 2, -1, 3, 1, -2, 4, 1, -3, 2};
  const cv::Size size(921, 666);
  cv::Mat places(size, CV_32FC2), expected;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const PicturePoint there = photograph_place(map, {x + 0.5, y + 0.5});
      places.at<cv::Vec2f>(y, x) = {static_cast<float>(there.x - 0.5), static_cast<float>(there.y - 0.5)};
    }
  cv::remap(enlarged, expected, places, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  const Image<Rgb8> found = warped(photograph, map, size);
  // OpenCV rounds places to 1/32 of a pixel: few are rounded elsewhere.
  const double pixels = size.area();
  EXPECT_LT(cv::norm(as_mat(found), expected, cv::NORM_L1) / pixels, 0.012);
}

}  // namespace wheatstone::warp_picture_test
