// What is said of matches that are poor, each for a reason of its own.

#include "wheatstone/matching/match_confidence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "scenes/spoiled_pair.h"
#include "scenes/test_photographs.h"
#include "wheatstone/random.h"

namespace wheatstone::match_confidence_test {

using testing::HasSubstr;

std::string warning_of(const StereoPair& pair, const std::optional<DisparityRange>& range = {}) {
  MatchOptions options;
  options.range = range;
  const MatchConfidence confidence = measure_match(pair, match(pair, options), range);
  testing::Test::RecordProperty(
      "confidence",
      fmt::format("found {:.3f} streaks {:.4f} colour {:.1f} plain {:.3f} overlap {:.3f} sharp "
                  "{:.3f} depth {:.2f}",
                  confidence.found_share, confidence.streak_share, confidence.colour_difference, confidence.plain_share,
                  confidence.overlap_share, confidence.sharper_share, confidence.depth_px));
  return match_warning(confidence);
}

Image<Rgb8> columns(const Image<Rgb8>& picture, int first, int count) {
  Image<Rgb8> part(count, picture.height());
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < count; ++x) part(x, y) = picture(first + x, y);
  return part;
}

/// A textured box before a plain wall with grain.
StereoPair before_a_plain_wall() {
  constexpr int width = 480, height = 360;
  StereoPair pair{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  for (const int eye : {0, 1}) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto at = [](int value) { return static_cast<std::uint64_t>(value) + 4096; };
        const int on_box = x + eye * 30;
        const bool box = on_box >= 190 && on_box < 330 && y >= 90 && y < 290;
        const float paper = 200 * unit_float(hash_keys({at(on_box / 3), at(y / 3), 5}));
        const float grain = 4 * unit_float(hash_keys({at(x), at(y), at(eye)}));
        const auto grey = static_cast<std::uint8_t>((box ? 20 + paper : 225) + grain);
        (eye == 0 ? pair.left : pair.right)(x, y) = {grey, grey, grey};
      }
    }
  }
  return pair;
}

TEST(MatchWarning, IsNotSaidOfGoodPairs) {
  EXPECT_EQ(warning_of(still_for_test()), "");
  for (const char* name : {"teddy", "motorcycle"}) {
    const auto pair = shared_pair(name);
    if (!pair) continue;
    EXPECT_EQ(warning_of(*pair), "") << name;
  }
}

TEST(MatchWarning, SaysThatTwoPicturesAreOfOnePlace) {
  const Image<Rgb8> left = still_for_test().left;
  EXPECT_THAT(warning_of({left, left}), HasSubstr("one place"));
}

TEST(MatchWarning, SaysThatASceneIsFlat) {
  const StereoPair wide = still_for_test();
  const StereoPair moved{columns(wide.left, 0, 440), columns(wide.left, 17, 440)};
  const MatchedPair matched = match(moved);
  EXPECT_THAT(match_warning(measure_match(moved, matched)), HasSubstr("about 17 pixels"));
  EXPECT_NEAR(matched.geometry.left_disparity(220, 180), 17, 0.5);
}

TEST(MatchWarning, NamesThePlainGround) { EXPECT_THAT(warning_of(before_a_plain_wall()), HasSubstr("plain")); }

TEST(MatchWarning, NamesTheBlurredEye) {
  StereoPair pair = still_for_test();
  cv::Mat right = as_mat(pair.right);
  cv::GaussianBlur(right, right, {}, 4);
  EXPECT_THAT(warning_of(pair), HasSubstr("right picture is blurred"));
}

TEST(MatchWarning, NamesTwoMoments) {
  // Another seed puts the same things elsewhere on the same table.
  EXPECT_THAT(warning_of({still_for_test(480, 360, 1).left, still_for_test(480, 360, 2).right}), HasSubstr("moved"));
}

TEST(MatchWarning, NamesTheSmallOverlap) {
  constexpr int width = 300, apart = 2 * width / 3;
  const StereoPair wide = still_for_test(640, 360);
  EXPECT_THAT(warning_of({columns(wide.left, 40, width), columns(wide.right, 40 + apart, width)}),
              HasSubstr("overlap"));
}

TEST(MatchWarning, NamesTheRangeThatEndsTooSoon) {
  const StereoPair still = still_for_test();
  const MatchedPair whole = match(still);
  const int middle = static_cast<int>(measure_match(still, whole).middle_px);
  for (const DisparityRange& range :
       {DisparityRange{whole.range.least, middle}, {middle, whole.range.largest}, {middle - 4, middle + 4}}) {
    const std::string warning = warning_of(still, range);
    EXPECT_THAT(warning, HasSubstr(fmt::format("at the end of the range {}:{}", range.least, range.largest)));
    EXPECT_THAT(warning, HasSubstr("widen --range"));
  }
  EXPECT_EQ(warning_of(still, whole.range), "");
}

TEST(MatchWarning, IsNotSaidWhereTheFarthestIsAtTheRangesEnd) {
  // A wall of disparity 0, and before it a board of disparity 12.
  StereoPair pair{still_for_test().left, still_for_test().left};
  for (int y = 100; y < 260; ++y)
    for (int x = 150; x < 330; ++x) {
      const auto grey = static_cast<std::uint8_t>(
          255 * unit_float(hash_keys({static_cast<std::uint64_t>(x / 2), static_cast<std::uint64_t>(y / 2)})));
      pair.right(x - 12, y) = pair.left(x, y) = {grey, grey, grey};
    }
  const MatchedPair matched = match(pair);
  ASSERT_NEAR(measure_match(pair, matched).middle_px, 0, 0.5);
  EXPECT_EQ(warning_of(pair, DisparityRange{0, 40}), "");
}

TEST(MatchWarning, NamesTheRangeThatIsFarTooWide) {
  const std::string warning = warning_of(still_for_test(), DisparityRange{-200, 300});
  EXPECT_THAT(warning, HasSubstr("the disparity range -200:300 is far wider than"));
  EXPECT_THAT(warning, HasSubstr("narrow --range"));
}

}  // namespace wheatstone::match_confidence_test
