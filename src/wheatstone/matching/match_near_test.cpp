// Matching near what is expected, where that is right, wrong, or unknown.

#include "wheatstone/matching/match_near.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "scenes/spoiled_pair.h"
#include "scenes/still_life.h"

namespace wheatstone::match_near_test {

/// Mean error in pixels over all pixels; none counts for more than 20.
double mean_error(const Image<float>& found, const Image<float>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i)
    sum += std::min(std::abs(found.pixels()[i] - truth.pixels()[i]), 20.f);
  return sum / static_cast<double>(found.pixels().size());
}

class MatchNear : public testing::Test {
 protected:
  MatchNear() {
    options_.matcher = Matcher::sgbm;
    options_.range = DisparityRange{0, 64};
  }
  double error_of(const Image<float>& expected) {
    const auto matched = match_near(still_.pictures, expected, options_);
    EXPECT_TRUE(matched);
    return mean_error(matched->geometry.left_disparity, still_.geometry.left_disparity);
  }
  const SyntheticStill& still_ = still_life(480, 320);
  MatchOptions options_;
};

TEST_F(MatchNear, IsAsGoodAsMatchingTheWholeRange) {
  const double whole =
      mean_error(match(still_.pictures, options_).geometry.left_disparity, still_.geometry.left_disparity);
  EXPECT_LE(error_of(still_.geometry.left_disparity), whole);
}

TEST_F(MatchNear, FindsWhatIsExpectedWronglyOrNotAtAll) {
  const Image<float>& truth = still_.geometry.left_disparity;
  const double right = error_of(truth);
  Image<float> wrong = truth;
  for (float& disparity : wrong.pixels()) disparity += 25;
  // Nearer than the band's half; what leads to it is the coarse copy alone.
  EXPECT_LE(error_of(wrong), 1.5 * right);
  EXPECT_LE(error_of(Image<float>(480, 320, std::numeric_limits<float>::quiet_NaN())), 1.5 * right);
}

TEST_F(MatchNear, ChangesFewPixelsWhereNoiseAloneChanges) {
  const StereoPair noisy = spoiled::noised(still_.pictures, 3);
  const Image<float> before =
      match_near(still_.pictures, still_.geometry.left_disparity, options_)->geometry.left_disparity;
  const auto changed_share = [&](const Image<std::uint8_t>& still) {
    const Image<float> now = match_near(noisy, before, options_, still)->geometry.left_disparity;
    double changed = 0;
    for (std::size_t i = 0; i < now.pixels().size(); ++i)
      changed += std::abs(now.pixels()[i] - before.pixels()[i]) > 1 ? 1 : 0;
    return changed / static_cast<double>(now.pixels().size());
  };
  const double still = changed_share(Image<std::uint8_t>(480, 320, 255)), moving = changed_share({});
  RecordProperty("changed", std::to_string(still) + " " + std::to_string(moving));
  EXPECT_LE(still, 0.25 * moving);
}

TEST_F(MatchNear, FindsNothingInBlackAndInTinyPictures) {
  const Image<float> flat(64, 48, 0);
  EXPECT_FALSE(match_near({Image<Rgb8>(16, 16), Image<Rgb8>(16, 16)}, Image<float>(16, 16, 0), options_));
  const auto black = match_near({Image<Rgb8>(64, 48), Image<Rgb8>(64, 48)}, flat, options_);
  EXPECT_TRUE(!black ||
              std::ranges::all_of(black->geometry.left_disparity.pixels(), [](float d) { return std::isfinite(d); }));
}

}  // namespace wheatstone::match_near_test
