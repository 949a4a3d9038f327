#include "wheatstone/image/known_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "wheatstone/random.h"

namespace wheatstone::known_runs_test {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Rows of no, of all and of some known pixels, at all places of a row's beginning and end.
Image<float> some_known() {
  Image<float> map(53, 40, unknown);
  for (int y = 1; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      if (unit_float(hash_keys({static_cast<std::uint64_t>(x / (1 + y % 7)), static_cast<std::uint64_t>(y)})) * 39 <
          static_cast<float>(y))
        map(x, y) = static_cast<float>(x - 100 * y);
  return map;
}

TEST(KnownRuns, TellEveryPixelOfTheMap) {
  const Image<float> map = some_known();
  const KnownRuns runs(map);
  ASSERT_EQ(runs.width(), map.width());
  ASSERT_EQ(runs.height(), map.height());
  std::size_t known = 0;
  std::vector<float> row(53);
  for (int y = 0; y < map.height(); ++y) {
    runs.copy_row(y, row);
    for (int x = 0; x < map.width(); ++x) {
      known += std::isnan(map(x, y)) ? 0 : 1;
      for (const float told : {runs(x, y), row[static_cast<std::size_t>(x)]})
        EXPECT_TRUE(told == map(x, y) || (std::isnan(told) && std::isnan(map(x, y)))) << x << ' ' << y;
    }
  }
  EXPECT_EQ(runs.values().size(), known);
}

TEST(KnownRuns, AreEqualWhereTheMapsAre) {
  Image<float> map = some_known();
  const KnownRuns runs(map);
  EXPECT_EQ(runs, KnownRuns(map));
  map(7, 39) += 1;
  EXPECT_NE(runs, KnownRuns(map));
  map = some_known();
  map(3, 0) = 5;
  EXPECT_NE(runs, KnownRuns(map));
  EXPECT_NE(KnownRuns(Image<float>(3, 2, unknown)), KnownRuns(Image<float>(3, 3, unknown)));
}

TEST(KnownRuns, OfAnEmptyMapAreEmpty) {
  const KnownRuns runs;
  EXPECT_EQ(runs.height(), 0);
  EXPECT_FALSE(runs.contains(0, 0));
  EXPECT_TRUE(runs.values().empty());
}

}  // namespace wheatstone::known_runs_test
