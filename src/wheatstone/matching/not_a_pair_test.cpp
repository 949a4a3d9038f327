#include "wheatstone/matching/not_a_pair.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "scenes/test_photographs.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::not_a_pair_test {

struct NamedPair {
  std::string name;
  StereoPair pair;
};

const std::vector<NamedPair>& all_pairs() {
  static const std::vector<NamedPair> made = [] {
    std::vector<NamedPair> pairs;
    for (const std::uint64_t seed : {1, 2})
      pairs.push_back({"still " + std::to_string(seed), still_for_test(480, 360, seed)});
    for (const char* name : {"teddy", "motorcycle", "aloe"})
      if (auto pair = shared_pair(name)) pairs.push_back({name, std::move(*pair)});
    return pairs;
  }();
  return made;
}

/// Two seeds move the same things about on the same table, neither one scene nor two: one of them only.
std::vector<NamedPair> pairs_of_different_scenes() {
  std::vector<NamedPair> pairs = all_pairs();
  pairs.erase(pairs.begin() + 1);
  return pairs;
}

void expect_two_scenes(const NamedPair& a, const NamedPair& b) {
  SCOPED_TRACE(a.name + ", " + b.name);
  const StereoPair mixed{a.pair.left, b.pair.right};
  const PairEvidence evidence = pair_evidence(mixed);
  EXPECT_LE(evidence.inliers, 12);
  EXPECT_LE(evidence.block_share, 0.03);
  EXPECT_TRUE(not_a_pair(mixed));
}

StereoPair swapped(const StereoPair& pair) { return {pair.right, pair.left}; }

TEST(NotAPair, IsNotSaidOfPairs) {
  for (const NamedPair& pair : all_pairs()) {
    SCOPED_TRACE(pair.name);
    const PairEvidence evidence = pair_evidence(pair.pair);
    testing::Test::RecordProperty(pair.name + " inliers", evidence.inliers);
    EXPECT_GE(evidence.inliers, 200);
    EXPECT_GE(evidence.block_share, 0.5);
    EXPECT_FALSE(not_a_pair(swapped(pair.pair)));
  }
}

TEST(NotAPair, IsSaidOfTwoScenes) {
  const std::vector<NamedPair> pairs = pairs_of_different_scenes();
  for (std::size_t i = 1; i < pairs.size(); ++i) expect_two_scenes(pairs[i], pairs[i - 1]);
}

TEST(NotAPairLong, IsSaidOfEveryTwoScenes) {
  const std::vector<NamedPair> pairs = pairs_of_different_scenes();
  for (const NamedPair& a : pairs)
    for (const NamedPair& b : pairs)
      if (a.name != b.name) expect_two_scenes(a, b);
}

TEST(NotAPair, IsNotSaidWhereThereIsTooLittleToGoBy) {
  EXPECT_FALSE(not_a_pair({Image<Rgb8>(64, 48, {9, 9, 9}), Image<Rgb8>(64, 48, {200, 9, 9})}));
  EXPECT_FALSE(not_a_pair({Image<Rgb8>(1, 1), Image<Rgb8>(1, 1)}));
}

TEST(EyeOrder, IsSeenWhereSwappedAndNeverWhereNot) {
  for (const NamedPair& pair : all_pairs()) {
    SCOPED_TRACE(pair.name);
    const EyeOrderEvidence right = eye_order_evidence(pair.pair), wrong = eye_order_evidence(swapped(pair.pair));
    testing::Test::RecordProperty(pair.name + " order", std::to_string(right.for_order));
    EXPECT_GE(right.for_order, 0.4);
    EXPECT_LE(wrong.for_order, -0.4);
    EXPECT_EQ(eye_order(pair.pair), EyeOrder::as_given);
    EXPECT_EQ(eye_order(swapped(pair.pair)), EyeOrder::swapped);
  }
}

TEST(EyeOrder, IsSeenWithinTheRangeOfThePairsDisparities) {
  for (const NamedPair& pair : all_pairs()) {
    SCOPED_TRACE(pair.name);
    const std::optional<DisparityRange> range = find_disparity_range(pair.pair);
    ASSERT_TRUE(range);
    EXPECT_EQ(eye_order(pair.pair, range), EyeOrder::as_given);
    EXPECT_EQ(eye_order(swapped(pair.pair), DisparityRange{-range->largest, -range->least}), EyeOrder::swapped);
  }
}

/// A pair that has become `width` pixels wide.
StereoPair narrowed(const StereoPair& pair, int width) {
  const PictureSize size{width, width * pair.left.height() / pair.left.width()};
  return {reduced(pair.left, size), reduced(pair.right, size)};
}

/// Pairs of this width: the still life cast at this size, and photographs made smaller.
std::vector<NamedPair> pairs_of_width(int width) {
  std::vector<NamedPair> pairs;
  for (const std::uint64_t seed : {1, 2, 3})
    pairs.push_back({"still " + std::to_string(seed), still_for_test(width, width * 3 / 4, seed)});
  for (const NamedPair& pair : all_pairs())
    if (pair.pair.left.width() > width && !pair.name.starts_with("still"))
      pairs.push_back({pair.name, narrowed(pair.pair, width)});
  return pairs;
}

void expect_order_seen_at(std::initializer_list<int> widths) {
  for (const int width : widths) {
    for (const NamedPair& pair : pairs_of_width(width)) {
      SCOPED_TRACE(pair.name + ", width " + std::to_string(width));
      EXPECT_EQ(eye_order(pair.pair), EyeOrder::as_given);
      EXPECT_EQ(eye_order(swapped(pair.pair)), EyeOrder::swapped);
    }
  }
}

TEST(EyeOrder, IsSeenInSmallPictures) { expect_order_seen_at({128}); }
TEST(EyeOrderLong, IsSeenInSmallPicturesOfAnyWidth) { expect_order_seen_at({160, 240, 320}); }

void expect_order_never_wrong_at(std::initializer_list<int> widths) {
  for (const int width : widths) {
    for (const NamedPair& pair : pairs_of_width(width)) {
      SCOPED_TRACE(pair.name + ", width " + std::to_string(width));
      EXPECT_NE(eye_order(pair.pair), EyeOrder::swapped);
      EXPECT_NE(eye_order(swapped(pair.pair)), EyeOrder::as_given);
    }
  }
}

TEST(EyeOrder, IsNeverWrongWherePicturesAreTooSmallToTellItAlways) { expect_order_never_wrong_at({32, 64, 96}); }
TEST(EyeOrderLong, IsNeverWrongAtAnyWidthThatIsTooSmall) { expect_order_never_wrong_at({48, 80}); }

TEST(EyeOrder, IsLeftOpenWhereNothingTells) {
  const StereoPair flat{Image<Rgb8>(200, 100, {9, 9, 9}), Image<Rgb8>(200, 100, {9, 9, 9})};
  EXPECT_EQ(eye_order(flat), EyeOrder::undecided);
  EXPECT_EQ(eye_order_evidence(flat).bands, 0);
  const Image<Rgb8> left = still_for_test().left;
  EXPECT_EQ(eye_order({left, left}), EyeOrder::undecided);
  EXPECT_EQ(eye_order({Image<Rgb8>(1, 1), Image<Rgb8>(1, 1)}), EyeOrder::undecided);
}

}  // namespace wheatstone::not_a_pair_test
