#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "scenes/still_life.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/retouch.h"

namespace wheatstone::plan_again_test {

/// A still life, which is touched by hand.
struct Retouched {
  explicit Retouched(const std::string& style_name, int width = several_blocks_px)
      : still(still_life(width, width * 3 / 4)), style(style_by_name(style_name)) {}

  static constexpr int several_blocks_px = 640;

  /// One touch of some kind, anywhere, across the border as well.
  void touch() {
    constexpr std::array kinds{Retouch::shift, Retouch::smooth, Retouch::set, Retouch::detail};
    const auto within = [this](float first, float end) {
      return std::uniform_real_distribution<float>(first, end)(random);
    };
    const auto width = static_cast<float>(still.pictures.left.width());
    Touch next{.kind = kinds[random() % kinds.size()],
               .x = within(-20, width + 20),
               .y = within(-20, width * 3 / 4 + 20),
               .radius_px = within(2, width / 9)};
    next.amount = next.kind == Retouch::detail ? within(-120, 120) : within(-8, 20);
    if (next.kind == Retouch::smooth) next.amount = within(1, 20);
    touches.push_back(next);
  }

  StereoGeometry geometry() const {
    Image<float> disparity = still.geometry.left_disparity;
    retouch_disparity(touches, still.pictures.left, disparity);
    return geometry_from_left(std::move(disparity));
  }

  Image<std::uint8_t> detail() const {
    if (!reads_detail(style)) return {};
    Image<std::uint8_t> map(still.pictures.left.width(), still.pictures.left.height(), even_detail);
    retouch_detail(touches, map);
    return map;
  }

  Painting anew() const { return plan_painting(still.pictures, geometry(), style, {}, widest_views, detail()); }
  Painting again(ViewRange views = widest_views) {
    return plan_again(still.pictures, geometry(), style, fits, {}, views, detail());
  }

  SyntheticStill still;
  Style style;
  std::vector<Touch> touches;
  StrokeFits fits;
  std::mt19937 random{7};
};

// Sanitizers look at what a touch does; whether the paintings are equal is the same without them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int rounds = 2;
#else
constexpr int rounds = 4;
#endif

TEST(PlanAgain, EqualsPlanningAnewAfterEachOfManyTouches) {
  Retouched picture("oil");
  EXPECT_EQ(picture.again(), picture.anew());
  for (int i = 0; i < rounds; ++i) {
    for (int k = i % 2; k >= 0; --k) picture.touch();
    ASSERT_EQ(picture.again(), picture.anew()) << "after touch " << picture.touches.size();
  }
}

TEST(PlanAgainLong, EqualsPlanningAnewAfterTwoHundredTouchesAndTheFirstWhenTheyAreUndone) {
  constexpr int touches = 200, compared_every = 20;
  Retouched picture("oil");
  const Painting first = picture.again();
  for (int i = 1; i <= touches; ++i) {
    picture.touch();
    const Painting again = picture.again();
    if (i % compared_every == 0) {
      ASSERT_EQ(again, picture.anew()) << "after touch " << i;
    }
  }
  while (!picture.touches.empty()) {
    picture.touches.pop_back();
    if (picture.touches.size() % compared_every == 0) picture.again();
  }
  EXPECT_EQ(picture.again(), first);
}

TEST(PlanAgain, GoesBackToTheFirstPaintingWhenTouchesAreUndone) {
  Retouched picture("oil");
  const Painting first = picture.again();
  for (int i = 0; i < 3; ++i) picture.touch();
  EXPECT_NE(picture.again(), first);
  picture.touches.clear();
  EXPECT_EQ(picture.again(), first);
}

TEST(PlanAgain, EqualsPlanningAnewForOtherPhotographsStylesAndSizes) {
  Retouched picture("oil", 400);
  picture.again();
  picture.style.fineness = 0.7f;
  EXPECT_EQ(picture.again(), picture.anew()) << "another fineness";
  picture.still = still_life(400, 300, 2);
  EXPECT_EQ(picture.again(), picture.anew()) << "another photograph";
  picture.still = still_life(360, 260);
  EXPECT_EQ(picture.again(), picture.anew()) << "another size";
}

TEST(PlanAgain, EqualsPlanningAnewForTheEyesAndThenForAllViews) {
  Retouched picture("oil", 320);
  picture.again();
  picture.touch();
  const Painting of_eyes =
      plan_painting(picture.still.pictures, picture.geometry(), picture.style, {}, ViewRange{}, picture.detail());
  EXPECT_EQ(picture.again(ViewRange{}), of_eyes);
  EXPECT_EQ(picture.again(), picture.anew());
}

class PlanAgainInStyle : public testing::TestWithParam<std::string> {};

TEST_P(PlanAgainInStyle, EqualsPlanningAnew) {
  Retouched picture(GetParam(), 240);
  picture.again();
  picture.touch();
  EXPECT_EQ(picture.again(), picture.anew());
}

INSTANTIATE_TEST_SUITE_P(EachKindOfMarks, PlanAgainInStyle,
                         testing::Values("impressionist", "dual", "posterise", "mosaic", "diffusion"),
                         [](const auto& each) { return each.param; });

}  // namespace wheatstone::plan_again_test
