// A row of one view, carried into another that is being put together.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <limits>
#include <vector>

#include "wheatstone/random.h"
#include "wheatstone/stereo/compose_row_internal.h"

namespace wheatstone::compose_row_test {

constexpr float nowhere = -std::numeric_limits<float>::infinity();
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// Runs side by side, with jumps between them, and places on which nothing lands.
struct Row {
  explicit Row(std::uint64_t seed) {
    for (std::uint64_t i = 0; i < width; ++i) {
      const std::uint64_t random = hash_keys({seed, i});
      const auto level = [&](int shift) { return static_cast<std::uint8_t>(random >> shift); };
      colours.push_back({level(0), level(8), level(16)});
      nearest.push_back(i / 20 % 4 == 3 ? nowhere : 5 + static_cast<float>(random % 5));
      x.push_back(static_cast<std::int32_t>(i / 40 * 30 + i % 40) % (width - 1));
      t.push_back(i % 3 == 0 ? 0 : static_cast<float>(random >> 40 & 255) / 256);
      picture.push_back({level(24), level(32), level(48)});
      disparity.push_back(i / 10 % 3 == 0 ? nothing : 6);
    }
  }
  static constexpr int width = 203;
  std::vector<Rgb8> colours, picture;
  std::vector<float> nearest, t, disparity;
  std::vector<std::int32_t> x;
};

void compose_plainly(Row& row, float tolerance_px) {
  for (std::size_t i = 0; i < Row::width; ++i) {
    if (row.nearest[i] == nowhere || row.disparity[i] + tolerance_px >= row.nearest[i]) continue;
    const auto from = static_cast<std::size_t>(row.x[i]);
    row.picture[i] = blend(row.colours[from], row.colours[from + 1], row.t[i]);
    row.disparity[i] = row.nearest[i];
  }
}

TEST(ComposeRow, IsWhatEachPixelWouldBeAloneWithEveryInstructionSet) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Row plain(seed);
    compose_plainly(plain, 1);
    ASSERT_NE(plain.picture, Row(seed).picture);
    for (const auto target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      Row row(seed);
      compose_row({row.colours, row.nearest, {row.x, row.t}}, 1, row.picture, row.disparity);
      EXPECT_EQ(row.picture, plain.picture) << hwy::TargetName(target);
      for (std::size_t i = 0; i < Row::width; ++i)
        EXPECT_TRUE(row.disparity[i] == plain.disparity[i] || plain.disparity[i] != plain.disparity[i]) << i;
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace wheatstone::compose_row_test
