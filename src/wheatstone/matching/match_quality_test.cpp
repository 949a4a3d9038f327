// What the presets of matching promise, on photographs with known disparity and on walls made to mislead.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "scenes/still_life.h"
#include "shared_data.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/map_flaws_internal.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/match_reliability_internal.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/random.h"

namespace wheatstone::match_quality_test {

struct Subject {
  StereoPair pictures;
  Image<float> truth;
};

/// Share of the pixels visible in both views that are off by more than 2 pixels, or unknown.
double bad_2(const Image<float>& found, const Image<float>& truth) {
  const Image<std::uint8_t> visible = visible_in_both(truth);
  double asked = 0, bad = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    if (visible.pixels()[i] == 0) continue;
    ++asked;
    bad += std::abs(found.pixels()[i] - truth.pixels()[i]) <= 2 ? 0 : 1;
  }
  return bad / asked;
}

double bad_2(const Subject& subject, MatchQuality quality) {
  const Image<float> found = match(subject.pictures, match_options_for(quality)).geometry.left_disparity;
  EXPECT_TRUE(std::ranges::all_of(found.pixels(), [](float d) { return std::isfinite(d); }));
  return bad_2(found, subject.truth);
}

enum class Wall { plain, repeated };

/// A wall at disparity 16 with a papered rim, plain or tiled in between, and a box before it at 40. Both eyes' noise is
/// their own.
Subject box_before(Wall wall) {
  constexpr int width = 480, height = 320, wall_px = 16, box_px = 40;
  const auto paper = [](int x, int y, std::uint64_t kind) {
    double value = 30;
    for (int octave = 0; octave < 3; ++octave) {
      const auto cell = [&](int at) { return static_cast<std::uint64_t>((at + 1024) / (2 << octave)); };
      value +=
          60 * static_cast<double>(unit_float(hash_keys({cell(x), cell(y), kind, static_cast<std::uint64_t>(octave)})));
    }
    return value;
  };
  const auto wall_value = [&](int x, int y) {
    if (x < 70 || x >= width - 50 || y < 50 || y >= height - 50) return paper(x, y, 1);
    if (wall == Wall::plain) return 170.0;
    constexpr double period_px = 16;
    return 120 + 50 * std::sin(2 * std::numbers::pi * x / period_px) +
           50 * std::sin(2 * std::numbers::pi * y / period_px);
  };
  Subject subject{{Image<Rgb8>(width, height), Image<Rgb8>(width, height)}, Image<float>(width, height, wall_px)};
  for (const bool right : {false, true}) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int on_box = right ? x + box_px : x, on_wall = right ? x + wall_px : x;
        const bool box = on_box >= 200 && on_box < 290 && y >= 110 && y < 220;
        const float noise =
            4 * unit_float(hash_keys({static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), right ? 8U : 7U}));
        const double value = (box ? paper(on_box, y, 2) : wall_value(on_wall, y)) + static_cast<double>(noise) - 2;
        const auto grey = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
        (right ? subject.pictures.right : subject.pictures.left)(x, y) = {grey, grey, grey};
        if (!right && box) subject.truth(x, y) = box_px;
      }
    }
  }
  return subject;
}

TEST(MatchQuality, FindsTeddyAsWellAsItPromises) {
  const std::filesystem::path folder = shared_data() / "stereo" / "teddy";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder.string();
  const Subject teddy{{read_image(folder / "left.png"), read_image(folder / "right.png")},
                      read_disparity(folder / "disp_left.png", 4.f)};
  const double fast = bad_2(teddy, MatchQuality::fast), good = bad_2(teddy, MatchQuality::good);
  const double best = bad_2(teddy, MatchQuality::best);
  RecordProperty("bad_2", std::to_string(fast) + " " + std::to_string(good) + " " + std::to_string(best));
  // Reached: .064, .033, .033. The same bytes on every run; another OpenCV or processor moves it by less than .005.
  EXPECT_LE(fast, 0.065);
  EXPECT_LE(good, 0.034);
  EXPECT_LE(best, 0.036);
  EXPECT_LE(streak_share(match(teddy.pictures).geometry.left_disparity), 0.015);
}

TEST(MatchQuality, BestIsNoWorseThanGood) {
  const SyntheticStill& still = still_life(480, 360);
  const Subject subject{still.pictures, still.geometry.left_disparity};
  EXPECT_LE(bad_2(subject, MatchQuality::best), bad_2(subject, MatchQuality::good) + 0.003);
}

TEST(MatchQuality, ReplacesWhatIsPlain) {
  const Subject subject = box_before(Wall::plain);
  // The naive method believes what it finds on the wall.
  MatchOptions naive;
  naive.matcher = Matcher::sgbm;
  const double believed = bad_2(match(subject.pictures, naive).geometry.left_disparity, subject.truth);
  EXPECT_GT(believed, 0.05);
  naive.distrust = true;
  EXPECT_LT(bad_2(match(subject.pictures, naive).geometry.left_disparity, subject.truth), 0.75 * believed);
  EXPECT_LT(bad_2(subject, MatchQuality::good), 0.02);
  EXPECT_LT(bad_2(subject, MatchQuality::best), 0.02);
}

TEST(MatchQuality, IsNotMisledByRepetition) {
  const Subject subject = box_before(Wall::repeated);
  // The naive method takes any of the tiles for any other.
  MatchOptions naive;
  naive.matcher = Matcher::bm;
  const Image<float> unchecked =
      match_with_opencv(as_mat(subject.pictures.left), as_mat(subject.pictures.right), {0, 64}, naive);
  EXPECT_GT(bad_2(unchecked, subject.truth), 0.2);
  EXPECT_LT(bad_2(subject, MatchQuality::best), 0.025);  // reached: .021
}

TEST(DistinctMatches, AreNeitherPlainNorRepeatedNorWrong) {
  const auto share = [](const Subject& subject, const Image<float>& disparity) {
    const Image<std::uint8_t> distinct =
        find_distinct_matches(as_mat(subject.pictures.left), as_mat(subject.pictures.right), disparity, {0, 64});
    const auto within = [&](int left, int top, int width, int height) {
      double sum = 0;
      for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x) sum += distinct(x, y) != 0 ? 1 : 0;
      return sum / (width * height);
    };
    return std::pair{within(90, 70, 80, 180), within(210, 120, 70, 90)};
  };
  for (const Wall wall : {Wall::plain, Wall::repeated}) {
    const Subject subject = box_before(wall);
    const auto [on_wall, on_box] = share(subject, subject.truth);
    EXPECT_LT(on_wall, 0.1);
    EXPECT_GT(on_box, 0.95);
    const Image<float> wrong(480, 320, 25);
    EXPECT_LT(share(subject, wrong).second, 0.05);
  }
}

TEST(MatchQuality, KnowsItsNames) {
  EXPECT_EQ(match_quality_by_name("best"), MatchQuality::best);
  EXPECT_FALSE(match_quality_by_name("better"));
  EXPECT_EQ(match_quality_names().size(), 3U);
}

}  // namespace wheatstone::match_quality_test
