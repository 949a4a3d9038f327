#include "wheatstone/measures/consistency.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "scenes/spoiled_pair.h"
#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::depth_survival_test {

TEST(DepthSurvival, FindsTheDepthOfUnspoiledPictures) {
  for (const bool converged : {false, true}) {
    const SyntheticStill& still = spoiled::small_still(converged);
    const DepthSurvival survival = measure_depth_survival(still.pictures, still.geometry.left_disparity);
    EXPECT_GT(survival.density, 0.93) << converged;
    EXPECT_LT(survival.bad_2, 0.10) << converged;
    EXPECT_LT(survival.end_point_error, 1) << converged;
    EXPECT_GE(survival.bad_1, survival.bad_2);
    EXPECT_GE(survival.bad_2, 1 - survival.density);  // an unmatched pixel is bad
  }
}

TEST(DepthSurvival, ComesOutBadlyForSpoiledPairs) {
  const SyntheticStill& still = spoiled::small_still();
  const auto bad_2 = [&](const StereoPair& pair) {
    return measure_depth_survival(pair, still.geometry.left_disparity).bad_2;
  };
  const double good = bad_2(still.pictures);
  EXPECT_GT(bad_2(spoiled::shifted(still.pictures, 3)), 0.9);
  EXPECT_GT(bad_2(spoiled::torn(still.pictures)), good + 0.2);
  EXPECT_GT(bad_2(spoiled::noised(still.pictures, 40)), good + 0.2);
  EXPECT_GT(bad_2(spoiled::blurred(still.pictures, 6)), good + 0.05);
}

TEST(DepthSurvival, AFlatPairLosesEverything) {
  const SyntheticStill& still = spoiled::small_still();
  const StereoPair flat{Image<Rgb8>(400, 300, {90, 90, 90}), Image<Rgb8>(400, 300, {90, 90, 90})};
  EXPECT_GT(measure_depth_survival(flat, still.geometry.left_disparity).bad_2, 0.95);
}

TEST(DepthSurvival, JudgesOnlyWhereTheTruthIsKnown) {
  const SyntheticStill& still = spoiled::small_still();
  // The wrong half of the truth is declared unknown.
  Image<float> half = still.geometry.left_disparity, wrong = half;
  for (int y = 150; y < 300; ++y) {
    for (float& d : half.row(y)) d = std::numeric_limits<float>::quiet_NaN();
    for (float& d : wrong.row(y)) d += 5;
  }
  EXPECT_LT(measure_depth_survival(still.pictures, half).bad_2, 0.12);
  EXPECT_GT(measure_depth_survival(still.pictures, wrong).bad_2, 0.4);
}

TEST(DepthSurvival, GivesThePhotographsTheirKnownValues) {
  const std::filesystem::path data = shared_data() / "stereo";
  if (!std::filesystem::exists(data / "motorcycle/left.png")) GTEST_SKIP() << "no shared data";
  const auto bad_2 = [&](const std::string& name, float scale) {
    return measure_depth_survival({read_image(data / name / "left.png"), read_image(data / name / "right.png")},
                                  read_disparity(data / name / "disp_left.png", scale))
        .bad_2;
  };
  EXPECT_NEAR(bad_2("motorcycle", 256), 0.063, 0.003);
  EXPECT_NEAR(bad_2("teddy", 4), 0.085, 0.003);
}

TEST(DepthSurvival, RefusesWhatDoesNotFit) {
  const StereoPair pair{Image<Rgb8>(32, 32), Image<Rgb8>(31, 32)};
  expect_error(ErrorKind::bad_input, "31x32", [&] { measure_depth_survival(pair, Image<float>(32, 32)); });
}

}  // namespace wheatstone::depth_survival_test
