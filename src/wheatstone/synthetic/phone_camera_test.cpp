#include "wheatstone/synthetic/phone_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace wheatstone::phone_camera_test {

constexpr SyntheticStillOptions small{.width = 320, .height = 240, .samples_a_side = 1};

/// Mean |left(p) − right(p's partner + error)| of the green channel, over pixels that have a partner.
double difference_of_partners(const PhonePair& pair, float error_px) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const int there_x = static_cast<int>(std::floor(static_cast<float>(x) + 0.5f + pair.left_to_right.x(x, y)));
      const int there_y =
          static_cast<int>(std::floor(static_cast<float>(y) + 0.5f + pair.left_to_right.y(x, y) + error_px));
      if (std::isnan(pair.left_to_right.x(x, y)) || !pair.pictures.right.contains(there_x, there_y)) continue;
      sum += std::abs(pair.pictures.left(x, y).g - pair.pictures.right(there_x, there_y).g);
      ++count;
    }
  EXPECT_GT(count, 320 * 240 * 3 / 4);
  return sum / count;
}

TEST(PhoneCamera, PartnersShowTheSame) {
  SyntheticStillOptions smooth = small;
  smooth.samples_a_side = 2;
  const PhonePair pair = make_phone_pair(smooth, {.right_exposure = 1, .noise = 0});
  EXPECT_LT(difference_of_partners(pair, 0), 4);
  EXPECT_GT(difference_of_partners(pair, 2), 1.7 * difference_of_partners(pair, 0));
}

TEST(PhoneCamera, HasRowsThatDiffer) {
  const PhonePair pair = make_phone_pair(small);
  const PhonePair straight = make_phone_pair(small, {.most_turn_degrees = 0, .radial_distortion = 0});
  double most = 0, most_straight = 0;
  for (int i = 0; i < 320 * 240; ++i) {
    const float turned_y = pair.left_to_right.y.pixels()[i], straight_y = straight.left_to_right.y.pixels()[i];
    if (!std::isnan(turned_y)) most = std::max(most, std::abs(static_cast<double>(turned_y)));
    if (!std::isnan(straight_y)) most_straight = std::max(most_straight, std::abs(static_cast<double>(straight_y)));
  }
  EXPECT_GT(most, 3);
  EXPECT_LT(most_straight, 1e-3);
}

TEST(PhoneCamera, ExposesTheEyesUnlikeAndMakesNoise) {
  const PhoneCameraOptions still{.most_turn_degrees = 0, .radial_distortion = 0, .right_exposure = 1, .noise = 0};
  PhoneCameraOptions noisy = still;
  noisy.noise = 4;
  noisy.right_exposure = 1.25;
  const PhonePair clean = make_phone_pair(small, still), spoiled = make_phone_pair(small, noisy);
  double square = 0, brighter = 0;
  int counted = 0;
  for (std::size_t i = 0; i < clean.pictures.left.pixels().size(); ++i) {
    const int before = clean.pictures.left.pixels()[i].g, after = spoiled.pictures.left.pixels()[i].g;
    brighter += spoiled.pictures.right.pixels()[i].g - clean.pictures.right.pixels()[i].g;
    if (before < 20 || before > 235) continue;
    square += (after - before) * (after - before);
    ++counted;
  }
  EXPECT_NEAR(std::sqrt(square / counted), 4, 0.1);
  EXPECT_GT(brighter / static_cast<double>(clean.pictures.left.pixels().size()), 5);
}

TEST(PhoneCamera, IsTheSameForTheSameSeed) {
  constexpr SyntheticStillOptions tiny{.width = 80, .height = 60, .samples_a_side = 1};
  const PhonePair first = make_phone_pair(tiny), again = make_phone_pair(tiny);
  EXPECT_EQ(first.pictures.left, again.pictures.left);
  EXPECT_EQ(first.pictures.right, again.pictures.right);
}

}  // namespace wheatstone::phone_camera_test
