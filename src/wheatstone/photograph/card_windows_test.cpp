#include "wheatstone/photograph/card_windows_internal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "scenes/stereograph_card.h"
#include "scenes/test_photographs.h"
#include "wheatstone/matching/eye_order.h"

namespace wheatstone::card_windows_test {

void expect_near(const CardWindow& found, const CardWindow& truth, int card_width) {
  const double most = 0.01 * card_width;
  EXPECT_NEAR(found.left, truth.left, most);
  EXPECT_NEAR(found.top, truth.top, most);
  EXPECT_NEAR(found.left + found.width, truth.left + truth.width, most);
  EXPECT_NEAR(found.top + found.height, truth.top + truth.height, most);
}

TEST(CardWindows, AreFoundToAHundredthOfTheCardsWidth) {
  const StereoPair pair = still_for_test();
  int seed = 0;
  for (const Rgb8 mount : {Rgb8{214, 188, 140}, Rgb8{118, 116, 108}, Rgb8{196, 92, 60}, Rgb8{240, 236, 224}}) {
    for (const double turn_deg : {-1.0, 0.0, 0.7}) {
      CardOptions options{.mount = mount, .turn_deg = turn_deg, .seed = ++seed};
      options.rounding = 0.12 * (seed % 5);
      options.width = seed % 2 == 0 ? 1000 : 1731;
      options.gutter_share = seed % 3 == 0 ? 0.012 : 0.03;
      SCOPED_TRACE(testing::Message() << "card " << seed << " turned by " << turn_deg);
      const TestCard card = make_card(pair, options);
      const std::optional<CardWindows> found = find_card_windows(card.picture);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->turn_deg, turn_deg, 0.25);
      EXPECT_EQ(found->left.width, found->right.width);
      EXPECT_EQ(found->left.height, found->right.height);
      expect_near(found->left, card.left, options.width);
      expect_near(found->right, card.right, options.width);
    }
  }
}

CardWindow in_picture(const CardWindows& found, CardWindow window) {
  window.left += found.card.left;
  window.top += found.card.top;
  return window;
}

TEST(CardWindows, AreFoundOnAScannersGroundAndWithoutAGap) {
  const StereoPair pair = still_for_test();
  for (const CardOptions& options : {CardOptions{.turn_deg = 0.6, .ground_share = 0.05},
                                     CardOptions{.mount = {118, 116, 108}, .turn_deg = -1, .gutter_share = 0},
                                     CardOptions{.rounding = 0.1, .gutter_share = 0, .ground_share = 0.1}}) {
    SCOPED_TRACE(testing::Message() << "ground " << options.ground_share << ", gap " << options.gutter_share);
    const TestCard card = make_card(pair, options);
    const std::optional<CardWindows> found = find_card_windows(card.picture);
    ASSERT_TRUE(found);
    expect_near(in_picture(*found, found->left), card.left, options.width);
    expect_near(in_picture(*found, found->right), card.right, options.width);
  }
  // One wide photograph on a mount.
  StereoPair other = pair;
  std::ranges::reverse(other.right.pixels());
  EXPECT_FALSE(find_card_windows(make_card(other, {.gutter_share = 0}).picture));
}

TEST(CardWindows, AreCutOutStraight) {
  const StereoPair pair = still_for_test();
  const TestCard card = make_card(pair, {.turn_deg = 1, .seed = 3});
  const std::optional<CardWindows> found = find_card_windows(card.picture);
  ASSERT_TRUE(found);
  const StereoPair cut = cut_card(card.picture, *found);
  ASSERT_EQ(cut.left.width(), found->left.width);
  ASSERT_TRUE(same_size(cut.left, cut.right));
  EXPECT_EQ(describe_card(*found).find("windows of "), 0u);
  EXPECT_NE(describe_card(*found).find("; the card is turned by 1.0 degrees"), std::string::npos);
}

// The mount in the corners cuts off what is nearer than it, which looks as if the eyes were swapped.
TEST(CardWindows, DoNotLookSwappedForTheirRoundedTops) {
  for (const auto& [scene, width] : {std::pair{3, 800}, {6, 1000}}) {
    SCOPED_TRACE(scene);
    const TestCard card =
        make_card(still_for_test(480, 360, scene), {.width = width, .turn_deg = 0.6, .rounding = 0.36, .seed = 24});
    const std::optional<CardWindows> found = find_card_windows(card.picture);
    ASSERT_TRUE(found);
    EXPECT_NE(eye_order(cut_card(card.picture, *found)), EyeOrder::swapped);
  }
}

TEST(CardWindows, AreNotSeenWhereThereAreNone) {
  const StereoPair pair = still_for_test();
  EXPECT_FALSE(find_card_windows(pair.left));
  EXPECT_FALSE(find_card_windows(joined(pair.left, pair.right, true)));
  EXPECT_FALSE(find_card_windows(Image<Rgb8>(500, 300, {200, 180, 140})));
  EXPECT_FALSE(find_card_windows(Image<Rgb8>(20, 20)));
  EXPECT_FALSE(find_card_windows(make_card(pair, {.photographs = 0}).picture));
  EXPECT_FALSE(find_card_windows(make_card(pair, {.photographs = 1}).picture));
}

}  // namespace wheatstone::card_windows_test
