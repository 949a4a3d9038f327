#include "wheatstone/matching/match.h"

#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <array>

#include <cmath>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "scenes/still_life.h"
#include "shared_data.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::match_test {

const SyntheticStill& still() { return still_life(480, 360); }

/// Share of the pixels visible in both views whose disparity is off by more than 2 pixels, or unknown.
double bad_2(const Image<float>& found, const Image<float>& truth) {
  const Image<std::uint8_t> visible = visible_in_both(truth);
  std::size_t asked = 0, bad = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    if (visible.pixels()[i] == 0) continue;
    ++asked;
    bad += std::abs(found.pixels()[i] - truth.pixels()[i]) <= 2 ? 0 : 1;
  }
  return static_cast<double>(bad) / static_cast<double>(asked);
}

double bad_2_of(const MatchOptions& options) {
  return bad_2(match(still().pictures, options).geometry.left_disparity, still().geometry.left_disparity);
}

TEST(Match, EveryMatcherBeatsWhatItFindsUnchecked) {
  // The naive method: block matching, each pixel's best, nothing checked or filled.
  MatchOptions naive;
  naive.matcher = Matcher::bm;
  naive.range = DisparityRange{0, 48};
  const Image<float> unchecked =
      match_with_opencv(as_mat(still().pictures.left), as_mat(still().pictures.right), *naive.range, naive);
  const double naive_bad = bad_2(unchecked, still().geometry.left_disparity);
  for (const std::string_view name : {"sgbm", "bm", "dp"}) {
    MatchOptions options;
    options.matcher = *matcher_by_name(name);
    const double bad = bad_2_of(options);
    RecordProperty(std::string("bad_2_") + std::string(name), std::to_string(bad));
    EXPECT_LT(bad, naive_bad) << name;
    EXPECT_LT(bad, 0.15) << name;
  }
}

TEST(Match, RefinementKeepsTheDisparity) {
  MatchOptions options;
  options.wls = true;
  EXPECT_LT(bad_2_of(options), 0.12);
}

TEST(Match, FindsTheRangeByItself) {
  const DisparityRange range = find_disparity_range(still().pictures).value();
  float least = INFINITY, largest = -INFINITY;
  for (const float d : still().geometry.left_disparity.pixels()) {
    least = std::min(least, d);
    largest = std::max(largest, d);
  }
  EXPECT_LE(static_cast<float>(range.least), least + 2);
  EXPECT_GE(static_cast<float>(range.largest), largest - 3);
  EXPECT_LT(range.largest - range.least, 3 * static_cast<int>(largest - least) + 32);
}

TEST(Match, WorksWhereDisparitiesHaveBothSigns) {
  const SyntheticStill& converged = still_life(320, 240, 1, true);
  const MatchedPair matched = match(converged.pictures);
  EXPECT_LT(matched.range.least, 0);
  EXPECT_LT(bad_2(matched.geometry.left_disparity, converged.geometry.left_disparity), 0.12);
}

TEST(Match, GivesTheSameOnEveryRunAndAnyNumberOfThreads) {
  Image<float> first;
  const int threads_before = cv::getNumThreads();
  for (const int threads : {1, 2, 3, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    cv::setNumThreads(threads);
    // A block that is wide against what is left of the width.
    MatchOptions options;
    options.block_px = 11;
    options.range = DisparityRange{0, 200};
    const Image<float> disparity = match(still().pictures, options).geometry.left_disparity;
    if (first.empty()) first = disparity;
    EXPECT_EQ(disparity, first);
  }
  cv::setNumThreads(threads_before);
}

TEST(Match, TakesTinyPictures) {
  StereoPair tiny{Image<Rgb8>(16, 16), Image<Rgb8>(16, 16)};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      tiny.left(x, y) =
          tiny.right(x, y) = {static_cast<std::uint8_t>(x * 37 * (y + 3)), static_cast<std::uint8_t>(y * 91), 7};
  MatchOptions options;
  options.range = DisparityRange{-4, 4};
  EXPECT_EQ(match(tiny, options).geometry.left_disparity.width(), 16);
}

TEST(Match, RefusesWhatIsTooSmallOrDoesNotFit) {
  EXPECT_THROW(match({Image<Rgb8>(3, 2), Image<Rgb8>(3, 2)}), Error);
  EXPECT_THROW(match({Image<Rgb8>(30, 20), Image<Rgb8>(30, 21)}), Error);
  MatchOptions options;
  options.range = DisparityRange{20, 10};
  EXPECT_THROW(match(still().pictures, options), Error);
  options = {};
  options.block_px = 4;
  EXPECT_THROW(match(still().pictures, options), Error);
}

TEST(Match, ReducesWhatIsTooLargeToBeMatchedAsItIs) {
  // 600 disparities are more than are looked for at full size.
  const SyntheticStill& wide = still_life(900, 300);
  MatchOptions options;
  options.range = DisparityRange{-520, 80};
  const MatchedPair matched = match(wide.pictures, options);
  EXPECT_LT(bad_2(matched.geometry.left_disparity, wide.geometry.left_disparity), 0.2);
}

TEST(Match, SaysWhenNothingMatches) {
  const StereoPair blank{Image<Rgb8>(64, 48, {128, 128, 128}), Image<Rgb8>(64, 48, {128, 128, 128})};
  MatchOptions options;
  options.matcher = Matcher::bm;
  EXPECT_THROW(match(blank, options), Error);
  EXPECT_FALSE(match_if_any(blank, options));
  EXPECT_TRUE(match_if_any(still().pictures, options));
}

TEST(Match, FindsNoRangeInBlackPictures) {
  EXPECT_FALSE(find_disparity_range({Image<Rgb8>(320, 180), Image<Rgb8>(320, 180)}));
}

TEST(Match, FindsTeddysTrueDisparities) {
  const std::filesystem::path folder = shared_data() / "stereo" / "teddy";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder.string();
  const StereoPair teddy{read_image(folder / "left.png"), read_image(folder / "right.png")};
  const Image<float> truth = read_disparity(folder / "disp_left.png", 4.f);
  EXPECT_LT(bad_2(match(teddy).geometry.left_disparity, truth), 0.08);
}

/// Shares of the pixels that have each confidence: 0, 128 and 255.
std::array<double, 3> confidences_of(const MatchedPair& matched) {
  std::array<double, 3> shares{};
  for (const std::uint8_t confidence : matched.left_confidence.pixels()) {
    EXPECT_TRUE(confidence == 0 || confidence == 128 || confidence == 255) << static_cast<int>(confidence);
    shares[static_cast<std::size_t>((confidence + 1) / 128)] +=
        1 / static_cast<double>(matched.left_confidence.pixels().size());
  }
  return shares;
}

TEST(MatchConfidencePicture, SaysWhereTheDisparityIsFound) {
  const SyntheticStill& still = still_life(320, 240);
  for (const double size : {1.0, 0.5}) {
    MatchOptions options;
    options.size = size;
    const MatchedPair matched = match(still.pictures, options);
    ASSERT_EQ(matched.left_confidence.width(), 320);
    EXPECT_GT(confidences_of(matched)[2], 0.6);
    // The right eye does not see what is hidden from it: less is sure there.
    std::array<double, 2> pixels{}, sure{};
    for (std::size_t i = 0; i < matched.left_confidence.pixels().size(); ++i) {
      const std::size_t hidden = still.geometry.left_occlusion.pixels()[i] == 0 ? 0 : 1;
      ++pixels[hidden];
      sure[hidden] += matched.left_confidence.pixels()[i] == 255 ? 1 : 0;
    }
    EXPECT_LT(sure[1] / pixels[1], 0.75 * sure[0] / pixels[0]) << size;
  }
  MatchOptions distrusting;
  distrusting.matcher = Matcher::sgbm;
  distrusting.distrust = true;
  EXPECT_GT(confidences_of(match(still.pictures, distrusting))[1], 0);
}

}  // namespace wheatstone::match_test
