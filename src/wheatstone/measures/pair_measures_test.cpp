#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "scenes/still_life.h"
#include "shared_data.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::pair_measures_test {

const SyntheticStill& still() { return still_life(480, 360); }

/// Each eye changed on its own: pixels swapped about at random within a few rows.
Image<Rgb8> torn(const Image<Rgb8>& picture, std::uint32_t seed) {
  Image<Rgb8> result = picture;
  for (int y = 0; y + 8 < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      seed = seed * 1664525u + 1013904223u;
      result(x, y) = picture(x, y + static_cast<int>(seed >> 29));
    }
  }
  return result;
}

Image<Rgb8> blurred(const Image<Rgb8>& picture) {
  Image<Rgb8> result = picture;
  cv::Mat target = as_mat(result);
  cv::GaussianBlur(as_mat(picture), target, {}, 4);
  return result;
}

TEST(LeftRightDifference, IsSmallForThePhotographsAndLargeForATornPair) {
  const Image<float>& truth = still().geometry.left_disparity;
  const auto own = measure_left_right_difference(still().pictures, truth);
  const auto bad =
      measure_left_right_difference({torn(still().pictures.left, 1), torn(still().pictures.right, 2)}, truth);
  EXPECT_LT(own.mean_absolute, 3);
  EXPECT_GT(bad.mean_absolute, 3 * own.mean_absolute);
  EXPECT_GT(bad.rmse, own.rmse);
  EXPECT_GT(own.compared_share, 0.7);
}

TEST(LeftRightDifference, IsExactForAShiftOfOnePixel) {
  // A ramp of 4 steps a pixel, seen without disparity but measured with one.
  StereoPair ramp{Image<Rgb8>(60, 4), Image<Rgb8>(60, 4)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 60; ++x)
      ramp.left(x, y) = ramp.right(x, y) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * x),
                                            static_cast<std::uint8_t>(4 * x)};
  EXPECT_NEAR(measure_left_right_difference(ramp, Image<float>(60, 4, 1)).mean_absolute, 4, 1e-6);
  // Half a pixel to the left of the first column there is nothing to interpolate.
  Image<float> half(60, 4, 0.5f);
  for (int y = 0; y < 4; ++y) half(0, y) = NAN;
  EXPECT_NEAR(measure_left_right_difference(ramp, half).rmse, 2.0 / 255, 1e-6);
}

TEST(GradientEnergy, FallsWithBlur) {
  EXPECT_LT(gradient_energy(blurred(still().pictures.left)), 0.5 * gradient_energy(still().pictures.left));
}

TEST(DepthSurvival, IsGoodForThePhotographsAndBadForATornPair) {
  const Image<float>& truth = still().geometry.left_disparity;
  const DepthSurvival own = measure_depth_survival(still().pictures, truth);
  const DepthSurvival bad =
      measure_depth_survival({torn(still().pictures.left, 1), torn(still().pictures.right, 2)}, truth);
  EXPECT_LT(own.bad_2, 0.15);
  EXPECT_GT(bad.bad_2, own.bad_2 + 0.1);
  EXPECT_LE(own.bad_2, own.bad_1);
}

TEST(DepthSurvival, CountsUnmatchedPixelsAsBad) {
  const StereoPair blank{Image<Rgb8>(200, 100, {90, 90, 90}), torn(still().pictures.right, 3)};
  StereoPair sized{blank.left, Image<Rgb8>(200, 100)};
  const DepthSurvival survival = measure_depth_survival(sized, Image<float>(200, 100, 5));
  EXPECT_GE(survival.bad_2, 1 - survival.density);
}

TEST(VisibleInBoth, LeavesOutWhatIsHiddenOutsideOrUnknown) {
  Image<float> disparity(50, 1, 2);
  for (int x = 20; x < 30; ++x) disparity(x, 0) = 8;
  disparity(40, 0) = NAN;
  const Image<std::uint8_t> visible = visible_in_both(disparity);
  EXPECT_EQ(visible(1, 0), 0);
  EXPECT_EQ(visible(15, 0), 0);
  EXPECT_EQ(visible(25, 0), 255);
  EXPECT_EQ(visible(40, 0), 0);
  EXPECT_EQ(visible(13, 0), 255);
}

TEST(Measures, AgreeWithWhatIsKnownOfTheMotorcyclePhotographs) {
  const std::filesystem::path folder = shared_data() / "stereo" / "motorcycle";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder.string();
  const StereoPair pair{read_image(folder / "left.png"), read_image(folder / "right.png")};
  const Image<float> truth = read_disparity(folder / "disp_left.png");
  EXPECT_NEAR(measure_depth_survival(pair, truth).bad_2, 0.063, 0.004);
  EXPECT_NEAR(measure_left_right_difference(pair, truth).rmse, 0.042, 0.002);
}

}  // namespace wheatstone::pair_measures_test
