// Pairs whose pictures differ by a few rows.

#include "wheatstone/stereo/picture_sizes.h"

#include <gtest/gtest.h>

#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::common_part_test {

Image<Rgb8> rows_of(const Image<Rgb8>& picture, int first, int count) {
  Image<Rgb8> part(picture.width(), count);
  for (int y = 0; y < count; ++y) std::copy_n(picture.row(first + y).begin(), part.width(), part.row(y).begin());
  return part;
}

TEST(CommonPart, IsThatOfTheSameRows) {
  const StereoPair still = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1}).pictures;
  for (const int first : {0, 1, 2, 3}) {
    StereoPair pair{still.left, rows_of(still.right, first, 177)};
    ASSERT_TRUE(differ_by_few({240, 180}, {240, 177}));
    frame_common_part(pair);
    EXPECT_EQ(pair.left, rows_of(still.left, first, 177)) << first;
    EXPECT_EQ(pair.right, rows_of(still.right, first, 177)) << first;
    StereoPair turned{rows_of(still.left, first, 177), still.right};
    frame_common_part(turned);
    EXPECT_EQ(turned.right, rows_of(still.right, first, 177)) << first;
  }
}

TEST(CommonPart, IsForAFewRowsOnly) {
  EXPECT_TRUE(differ_by_few({741, 500}, {741, 494}));
  EXPECT_TRUE(differ_by_few({741, 500}, {739, 500}));
  EXPECT_FALSE(differ_by_few({741, 500}, {741, 500}));
  EXPECT_FALSE(differ_by_few({741, 500}, {741, 480}));
  EXPECT_FALSE(differ_by_few({741, 500}, {500, 741}));
}

}  // namespace wheatstone::common_part_test
