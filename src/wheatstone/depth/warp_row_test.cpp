// Scan lines of disparities, carried to other views.

#include "wheatstone/depth/warp_row.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>
#include <vector>

#include "wheatstone/random.h"

namespace wheatstone::warp_row_test {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Runs of one disparity with small and large steps between them, and some pixels of which nothing is known.
std::vector<float> uneven_line(std::uint64_t seed) {
  std::vector<float> line;
  float disparity = 8;
  for (std::uint64_t run = 0; line.size() < 300; ++run) {
    const std::uint64_t random = hash_keys({seed, run});
    const float step = static_cast<float>(random % 33) / 16 - 1;
    disparity += random % 7 == 0 ? 8 * step : step;
    line.insert(line.end(), 1 + (random >> 8) % 9, random % 11 == 0 ? unknown : disparity);
  }
  return line;
}

/// Pixel by pixel.
template <bool every_pixel>
std::vector<float> plainly_warped(const std::vector<float>& line, float separation, int left_px,
                                  std::vector<float> nearest) {
  warp_row<every_pixel>(line, separation, static_cast<int>(nearest.size()), left_px,
                        [&](int target, float d, int, float) {
                          if (!(nearest[target] >= d)) nearest[target] = d;
                        });
  return nearest;
}

/// NaN equals NaN.
bool are_equal(const std::vector<float>& a, const std::vector<float>& b) {
  return std::ranges::equal(a, b, [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

template <bool every_pixel>
void expect_the_plain_way() {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<float> line = uneven_line(seed);
    for (const float separation : {-2.5f, -1.f, -0.3f, 0.f, 0.25f, 0.5f, 1.1f, 2.f}) {
      std::vector<float> nearest(280, unknown);
      std::fill_n(nearest.begin() + 40, 50, 10.f);
      std::vector<float> moved = nearest;
      warp_disparity_row_over(line, separation, -7, moved,
                              every_pixel ? Landing::every_pixel : Landing::edges_and_surfaces);
      EXPECT_TRUE(are_equal(moved, plainly_warped<every_pixel>(line, separation, -7, nearest))) << seed << separation;
    }
  }
}

TEST(WarpRow, LandsPixelsOfWholeVectorsWhereEachWouldAlone) {
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    SCOPED_TRACE(hwy::TargetName(target));
    expect_the_plain_way<true>();
    expect_the_plain_way<false>();
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// Slopes on which a vector of pixels lands side by side for a while.
std::vector<float> sloping_line(std::uint64_t seed) {
  std::vector<float> line = uneven_line(seed);
  for (std::size_t x = 100; x < 200; ++x) line[x] = 6 + 0.013f * static_cast<float>(x + seed);
  return line;
}

TEST(WarpRow, TellsWhereWhatLandsComesFrom) {
  constexpr float nothing = -std::numeric_limits<float>::infinity();
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const std::vector<float> line = sloping_line(seed);
      std::vector<float> nearest(280, nothing), t(280), plain(280, nothing), plain_from(280);
      std::vector<std::int32_t> x(280);
      warp_disparity_row_over(line, 0.7f, -7, nearest, {x, t});
      warp_row<false>(line, 0.7f, 280, -7, [&](int at, float d, int from, float fraction) {
        if (plain[at] >= d) return;
        plain[at] = d;
        plain_from[at] = static_cast<float>(from) + fraction;
      });
      EXPECT_EQ(nearest, plain) << hwy::TargetName(target) << ' ' << seed;
      for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_NEAR(static_cast<float>(x[i]) + t[i], plain_from[i], 1e-4) << hwy::TargetName(target) << ' ' << seed;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace wheatstone::warp_row_test
