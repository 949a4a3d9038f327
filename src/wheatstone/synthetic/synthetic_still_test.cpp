#include "wheatstone/synthetic/synthetic_still.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "throws_error.h"

namespace wheatstone::synthetic_still_test {

SyntheticStillOptions small(std::uint64_t seed = 1) {
  SyntheticStillOptions options;
  options.width = 320;
  options.height = 240;
  options.seed = seed;
  return options;
}

/// The same scene with one sample a pixel, where colours count only as being the same or not.
SyntheticStillOptions plain(std::uint64_t seed = 1) {
  SyntheticStillOptions options = small(seed);
  options.samples_a_side = 1;
  return options;
}

const SyntheticStill& still_of_small() {
  static const SyntheticStill made = make_synthetic_still(small());
  return made;
}

/// A value between two pixels of a row; x counts from the row's left edge, so that pixel 0's is at ½.
template <class Value>
double between(Value value, double x, int width) {
  const double place = std::clamp(x - 0.5, 0.0, width - 1.0);
  const int before = static_cast<int>(place), after = std::min(before + 1, width - 1);
  return std::lerp(value(before), value(after), place - before);
}

/// Mean |own(x) − other(x − shift · d + error)| over the pixels of `own` whose point the other view also sees.
template <class Seen>
double mean_difference(const Image<Rgb8>& own, const Image<Rgb8>& other, const Image<float>& disparity, double shift,
                       double error_px, Seen seen) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < own.height(); ++y) {
    for (int x = 0; x < own.width(); ++x) {
      if (!seen(x, y)) continue;
      const double there = x + 0.5 - shift * disparity(x, y) + error_px;
      for (const auto channel : {&Rgb8::r, &Rgb8::g, &Rgb8::b})
        sum += std::abs(own(x, y).*channel -
                        between([&](int i) { return static_cast<double>(other(i, y).*channel); }, there, own.width()));
      ++count;
    }
  }
  EXPECT_GT(count, own.width() * own.height() / 2);
  return sum / (3.0 * count);
}

TEST(SyntheticStill, APointHasTheSameColourInBothEyes) {
  const SyntheticStill& still = still_of_small();
  const auto seen = [&](int x, int y) { return still.geometry.left_occlusion(x, y) == 0; };
  const auto difference = [&](double error_px) {
    return mean_difference(still.pictures.left, still.pictures.right, still.geometry.left_disparity, 1, error_px, seen);
  };
  EXPECT_LT(difference(0), 2.0);
  // The measure notices half a pixel.
  EXPECT_GT(difference(0.5), 1.5 * difference(0));
  EXPECT_GT(difference(-0.5), 1.5 * difference(0));
}

TEST(SyntheticStill, RightEyeAgreesWithLeft) {
  const SyntheticStill& still = still_of_small();
  const StereoGeometry& g = still.geometry;
  int seen = 0, agree = 0, occluded = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      occluded += g.right_occlusion(x, y) != 0;
      if (g.right_occlusion(x, y) != 0) continue;
      const double there = x + 0.5 + g.right_disparity(x, y);
      ASSERT_TRUE(there >= 0 && there < 320);
      ++seen;
      agree +=
          std::abs(g.right_disparity(x, y) - between([&](int i) { return g.left_disparity(i, y); }, there, 320)) < 0.25;
    }
  }
  EXPECT_GT(agree, 0.95 * seen);  // the rest lies beside depth edges, where interpolation mixes two things
  EXPECT_GT(occluded, 0.03 * 320 * 240);
}

// A z-buffer by brute force: the other view five times finer, whose rows meet the coarse pixels' centres. Where all of
// it about a pixel's counterpart is nearer the pixel is hidden, where none is it is not; between lie only edges.
TEST(SyntheticStill, OcclusionAgreesWithBruteForce) {
  constexpr int finer = 5, width = 160, height = 120;
  for (const bool converged : {false, true}) {
    SyntheticStillOptions options = small(3);
    options.width = width;
    options.height = height;
    options.converged = converged;
    const StereoGeometry g = make_synthetic_still(options).geometry;
    options.width *= finer;
    options.height *= finer;
    options.samples_a_side = 1;
    const Image<float> fine = make_synthetic_view(options, right_eye).disparity;
    int undecided = 0, hidden = 0, wrong = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float d = g.left_disparity(x, y), there = static_cast<float>(x) + 0.5f - d;
        const bool occluded = g.left_occlusion(x, y) != 0;
        if (there < 0 || there >= width) {
          EXPECT_TRUE(occluded);
          continue;
        }
        const int middle = static_cast<int>(there * finer);
        float farthest = INFINITY, nearest = -INFINITY;
        for (int i = std::max(middle - 1, 0); i <= std::min(middle + 1, width * finer - 1); ++i) {
          farthest = std::min(farthest, fine(i, finer * y + finer / 2) / finer);
          nearest = std::max(nearest, fine(i, finer * y + finer / 2) / finer);
        }
        const bool surely_hidden = farthest > d + 0.1f, surely_seen = nearest < d + 0.05f && farthest > d - 0.05f;
        hidden += surely_hidden;
        undecided += !surely_hidden && !surely_seen;
        wrong += (surely_hidden && !occluded) || (surely_seen && occluded);
      }
    }
    // Petals that all but touch are nearer to one another than the fine view tells.
    EXPECT_LT(wrong, width * height / 1000);
    EXPECT_GT(hidden, width * height / 50);
    EXPECT_LT(undecided, width * height / 20);
  }
}

TEST(SyntheticStill, CentralViewLiesHalfWay) {
  const SyntheticStillOptions options = small(2);
  const SyntheticStill still = make_synthetic_still(options);
  const SyntheticView central = make_synthetic_view(options, central_view);
  // x(−½) = x(0) + ½ d, and the left view knows the same disparity there.
  const auto seen = [&](int x, int y) {
    const int there = static_cast<int>(std::floor(static_cast<float>(x) + 0.5f + 0.5f * central.disparity(x, y)));
    return there >= 0 && there < 320 &&
           std::abs(still.geometry.left_disparity(there, y) - central.disparity(x, y)) < 0.3f;
  };
  EXPECT_LT(mean_difference(central.picture, still.pictures.left, central.disparity, -0.5, 0, seen), 2.0);
  EXPECT_GT(mean_difference(central.picture, still.pictures.left, central.disparity, 0.5, 0, seen), 6.0);
}

TEST(SyntheticStill, EyesAreViewsAtHalfADisparity) {
  const SyntheticStill& still = still_of_small();
  const SyntheticView left = make_synthetic_view(small(), left_eye), right = make_synthetic_view(small(), right_eye);
  EXPECT_EQ(left.picture, still.pictures.left);
  EXPECT_EQ(left.disparity, still.geometry.left_disparity);
  EXPECT_EQ(right.picture, still.pictures.right);
}

TEST(SyntheticStill, DisparitiesHaveTheRangeAskedFor) {
  const auto range = [](SyntheticStillOptions options) {
    options.samples_a_side = 1;
    const SyntheticView view = make_synthetic_view(options, left_eye);
    const auto [least, largest] = std::minmax_element(view.disparity.pixels().begin(), view.disparity.pixels().end());
    return std::pair{*least, *largest};
  };
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto [least, largest] = range(small(seed));
    EXPECT_NEAR(least, 3, 0.3);  // half of what a picture 640 wide has
    EXPECT_NEAR(largest, 22.5, 0.3);
  }
  SyntheticStillOptions asked = small();
  asked.largest_disparity_px = 20;
  asked.least_disparity_px = -3;
  EXPECT_NEAR(range(asked).first, -3, 0.3);
  EXPECT_NEAR(range(asked).second, 20, 0.3);
  SyntheticStillOptions converged = small();
  converged.converged = true;
  EXPECT_NEAR(range(converged).first, -9.75, 0.3);
  EXPECT_NEAR(range(converged).second, 9.75, 0.3);
}

TEST(SyntheticStill, ConvergenceOnlyShiftsTheViews) {
  SyntheticStillOptions options = plain();
  options.largest_disparity_px = 26;
  options.least_disparity_px = 2;
  const SyntheticView parallel = make_synthetic_view(options, left_eye);
  options.converged = true;  // by 14 px in all: 7 an eye
  const SyntheticView converged = make_synthetic_view(options, left_eye);
  for (int y = 0; y < 240; y += 7)
    for (int x = 0; x < 300; x += 5)
      ASSERT_NEAR(parallel.disparity(x + 7, y) - 14, converged.disparity(x, y), 0.02) << x << ", " << y;
}

TEST(SyntheticStill, ATwiceLargerPictureShowsTheSameScene) {
  SyntheticStillOptions large = small();
  large.width = 640;
  large.height = 480;
  const SyntheticView once = make_synthetic_view(small(), central_view),
                      twice = make_synthetic_view(large, central_view);
  int agree = 0;
  double colour_difference = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      agree += std::abs(2 * once.disparity(x, y) - twice.disparity(2 * x, 2 * y)) < 0.5f;
      const int sum = twice.picture(2 * x, 2 * y).g + twice.picture(2 * x + 1, 2 * y).g +
                      twice.picture(2 * x, 2 * y + 1).g + twice.picture(2 * x + 1, 2 * y + 1).g;
      colour_difference += std::abs(once.picture(x, y).g - 0.25 * sum);
    }
  }
  EXPECT_GT(agree, 0.97 * 320 * 240);
  EXPECT_LT(colour_difference / (320 * 240), 4.0);  // the larger one has finer detail
}

TEST(SyntheticStill, HasTextureWhereverAMatcherLooks) {
  const Image<Rgb8> picture = make_synthetic_view(small(), left_eye).picture;
  int flat = 0, windows = 0;
  for (int y = 0; y + 9 <= 240; y += 9) {
    for (int x = 0; x + 9 <= 320; x += 9) {
      int least = 255, largest = 0;
      for (int i = 0; i < 81; ++i) {
        const int g = picture(x + i % 9, y + i / 9).g;
        least = std::min(least, g), largest = std::max(largest, g);
      }
      flat += largest - least < 4;
      ++windows;
    }
  }
  EXPECT_LT(flat, 0.03 * windows);
}

TEST(SyntheticStill, TheSeedDecides) {
  EXPECT_EQ(make_synthetic_view(plain(5), central_view).picture, make_synthetic_view(plain(5), central_view).picture);
  const SyntheticView one = make_synthetic_view(plain(5), central_view),
                      other = make_synthetic_view(plain(6), central_view);
  int differ = 0, moved = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      differ += one.picture(x, y) != other.picture(x, y);
      moved += std::abs(one.disparity(x, y) - other.disparity(x, y)) > 0.5f;
    }
  EXPECT_GT(differ, 320 * 240 / 2);
  EXPECT_GT(moved, 320 * 240 / 100);
}

TEST(SyntheticStill, IsTheSameOnAnyNumberOfThreads) {
  SyntheticStill alone, crowd;
  tbb::task_arena(1).execute([&] { alone = make_synthetic_still(plain()); });
  const tbb::global_control seven(tbb::global_control::max_allowed_parallelism, 7);
  tbb::task_arena(7).execute([&] { crowd = make_synthetic_still(plain()); });
  EXPECT_EQ(alone.pictures.left, crowd.pictures.left);
  EXPECT_EQ(alone.pictures.right, crowd.pictures.right);
  EXPECT_EQ(alone.geometry.right_disparity, crowd.geometry.right_disparity);
  EXPECT_EQ(alone.geometry.left_occlusion, crowd.geometry.left_occlusion);
}

TEST(SyntheticStill, EveryPixelHasAFiniteDisparityAtAnyAspect) {
  for (const auto& [width, height] : {std::pair{400, 50}, {50, 400}, {17, 16}}) {
    SyntheticStillOptions options;
    options.width = width;
    options.height = height;
    const SyntheticView view = make_synthetic_view(options, right_eye);
    EXPECT_TRUE(std::ranges::all_of(view.disparity.pixels(), [](float d) { return std::isfinite(d); }));
  }
}

TEST(SyntheticStill, RefusesNonsense) {
  const auto refused = [](const std::string& part, auto change) {
    SyntheticStillOptions options;
    change(options);
    expect_error(ErrorKind::wrong_usage, part, [&] { make_synthetic_still(options); });
  };
  refused("0x720 pixels", [](auto& o) { o.width = 0; });
  refused("960x100000 pixels", [](auto& o) { o.height = 100000; });
  refused("960x16 pixels", [](auto& o) { o.height = 16; });
  refused("0 samples", [](auto& o) { o.samples_a_side = 0; });
  refused("nan", [](auto& o) { o.largest_disparity_px = NAN; });
  refused("from 90 to 10 px", [](auto& o) { o.least_disparity_px = 90, o.largest_disparity_px = 10; });
}

}  // namespace wheatstone::synthetic_still_test
