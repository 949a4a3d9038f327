#include "wheatstone/measures/consistency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "scenes/spoiled_pair.h"
#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::consistency_test {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

Image<float> row_of(const std::vector<float>& values) {
  Image<float> image(static_cast<int>(values.size()), 1);
  std::ranges::copy(values, image.pixels().begin());
  return image;
}

TEST(VisibleInBoth, HasHandComputedValues) {
  //                                0  1        2  3  4  5  6
  const Image<float> step = row_of({1, unknown, 0, 0, 2, 2, 0});
  // Pixel 0 leaves the picture, 1 is unknown; 4 and 5 land on 2 and 3 and hide what is there by two pixels of
  // disparity.
  const std::vector<std::uint8_t> expected{0, 0, 0, 0, 255, 255, 255};
  const Image<std::uint8_t> visible = visible_in_both(step);
  for (int x = 0; x < 7; ++x) EXPECT_EQ(visible(x, 0), expected[x]) << x;
}

TEST(VisibleInBoth, ToleratesOnePixelOfDisparity) {
  EXPECT_EQ(visible_in_both(row_of({0, 0, 1}))(1, 0), 255);
  EXPECT_EQ(visible_in_both(row_of({0, 0, 1.1f}))(1, 0), 0);
}

TEST(LeftRightDifference, HasHandComputedValues) {
  StereoPair pair{Image<Rgb8>(8, 4, {100, 100, 100}), Image<Rgb8>(8, 4, {110, 100, 70})};
  const LeftRightDifference difference = measure_left_right_difference(pair, Image<float>(8, 4, 2.f));
  EXPECT_NEAR(difference.mean_absolute, (10 + 0 + 30) / 3.0, 1e-9);
  EXPECT_NEAR(difference.rmse, std::sqrt((100 + 0 + 900) / 3.0) / 255, 1e-9);
  EXPECT_NEAR(difference.compared_share, 6 / 8.0, 1e-9);
}

TEST(LeftRightDifference, InterpolatesAlongTheScanLine) {
  StereoPair pair{Image<Rgb8>(16, 1), Image<Rgb8>(16, 1)};
  for (int x = 0; x < 16; ++x) {
    const auto left = static_cast<std::uint8_t>(8 * x), right = static_cast<std::uint8_t>(8 * x + 20);
    pair.left(x, 0) = {left, left, left};
    pair.right(x, 0) = {right, right, right};  // the same ramp, 2.5 pixels on
  }
  // Fourteen are compared; the first lies half a pixel before the outermost centre, where its value is held.
  EXPECT_NEAR(measure_left_right_difference(pair, Image<float>(16, 1, 2.5f)).mean_absolute, 4 / 14.0, 1e-6);
  EXPECT_NEAR(measure_left_right_difference(pair, Image<float>(16, 1, 2.f)).mean_absolute, 4, 1e-6);
}

TEST(LeftRightDifference, ComesOutBadlyForPairsThatDoNotFuse) {
  const SyntheticStill& still = spoiled::small_still();
  const auto rmse = [&](const StereoPair& pair) {
    return measure_left_right_difference(pair, still.geometry.left_disparity).rmse;
  };
  const double good = rmse(still.pictures);
  EXPECT_LT(good, 0.035);
  EXPECT_GT(rmse(spoiled::shifted(still.pictures, 2)), 1.8 * good);
  EXPECT_GT(rmse(spoiled::torn(still.pictures)), 1.8 * good);
  EXPECT_GT(rmse(spoiled::noised(still.pictures, 25)), 2 * good);
}

TEST(GradientEnergy, HasHandComputedValues) {
  Image<Rgb8> ramp(16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const auto value = static_cast<std::uint8_t>(3 * x + 4 * y);
      ramp(x, y) = {value, value, value};
    }
  // Steps of 3 and 4: 25 inside; at the reflecting borders one of the two vanishes.
  const double inside = 14 * 14 * 25.0, sides = 2 * 14 * (9.0 + 16.0);
  EXPECT_NEAR(gradient_energy(ramp), (inside + sides) / 256, 1e-6);
  EXPECT_EQ(gradient_energy(Image<Rgb8>(5, 5, {9, 200, 3})), 0);
}

// Blur makes the eyes more alike: what catches it is the gradient energy, of both and between them.
TEST(GradientEnergy, TellsBlurWhichTheDifferenceRewards) {
  const SyntheticStill& still = spoiled::small_still();
  const StereoPair photographs = spoiled::noised(still.pictures, 8);  // as cameras make them
  const StereoPair blurred = spoiled::blurred(photographs, 2);
  const auto rmse = [&](const StereoPair& pair) {
    return measure_left_right_difference(pair, still.geometry.left_disparity).rmse;
  };
  EXPECT_LT(rmse(blurred), 0.8 * rmse(photographs));
  EXPECT_LT(gradient_energy(blurred.left), 0.5 * gradient_energy(photographs.left));
  EXPECT_NEAR(gradient_energy(photographs.right) / gradient_energy(photographs.left), 1, 0.05);
  EXPECT_LT(gradient_energy(blurred.right) / gradient_energy(photographs.left), 0.5);
}

TEST(LeftRightDifference, GivesThePhotographsTheirKnownValues) {
  const std::filesystem::path data = shared_data() / "stereo";
  if (!std::filesystem::exists(data / "motorcycle/left.png")) GTEST_SKIP() << "no shared data";
  const auto rmse = [&](const std::string& name, float scale) {
    return measure_left_right_difference({read_image(data / name / "left.png"), read_image(data / name / "right.png")},
                                         read_disparity(data / name / "disp_left.png", scale))
        .rmse;
  };
  EXPECT_NEAR(rmse("motorcycle", 256), 0.042, 0.0005);
  EXPECT_NEAR(rmse("teddy", 4), 0.032, 0.0005);
}

TEST(LeftRightDifference, RefusesWhatDoesNotFit) {
  const StereoPair pair{Image<Rgb8>(8, 4), Image<Rgb8>(8, 4)};
  expect_error(ErrorKind::bad_input, "of 7x4", [&] { measure_left_right_difference(pair, Image<float>(7, 4)); });
}

}  // namespace wheatstone::consistency_test
