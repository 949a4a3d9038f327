// A view as a value: what it keeps, where it lies, and the same view at another scale.

#include "wheatstone/stereo/view.h"

#include <gtest/gtest.h>

#include "wheatstone/stereo/view_scale.h"

namespace wheatstone::view_test {

TEST(SharedImage, BorrowsWhatGoesOnToExistAndOwnsWhatIsGivenAway) {
  Image<int> image(2, 1, 7);
  const SharedImage<int> lent = image;
  EXPECT_EQ(lent.data(), image.view().data());
  const int* const pixels = image.view().data();
  SharedImage<int> copy;
  {
    const SharedImage<int> owned = std::move(image);
    EXPECT_EQ(owned.data(), pixels) << "without a copy";
    copy = owned;
  }
  EXPECT_EQ(copy.data(), pixels) << "which outlives the first owner";
  EXPECT_EQ(copy(1, 0), 7);
  EXPECT_TRUE(SharedImage<int>().empty());
}

constexpr Rgb8 near_colour{200, 0, 0}, far_colour{0, 0, 100};

/// Six pixels wide and two high, far but for two near columns; of the far ones before the first some are wanted.
View near_columns() {
  Image<Rgb8> colour(6, 2, far_colour);
  Image<float> disparity(6, 2, 4.f);
  for (int y = 0; y < 2; ++y) {
    for (const int x : {2, 4}) {
      colour(x, y) = near_colour;
      disparity(x, y) = 12;
    }
  }
  Image<std::uint8_t> wanted(6, 2);
  wanted(4, 1) = wanted(2, 0) = wanted(2, 1) = wanted(3, 0) = 255;
  return {std::move(colour), std::move(disparity), std::move(wanted), right_eye, {8, 2}};
}

TEST(SmallerView, APixelOfSeveralSurfacesIsOfTheFarthestThatIsWanted) {
  const View half = smaller_view(near_columns(), 2);
  EXPECT_EQ(half.frame, (ViewFrame{8, 4}));
  EXPECT_EQ(half.position, right_eye);
  EXPECT_EQ(half.disparity(0, 0), 2);
  EXPECT_EQ(half.disparity(1, 0), 2) << "the first pixel is near";
  EXPECT_EQ(half.colour(1, 0), far_colour) << "not mixed";
  EXPECT_EQ(half.disparity(2, 0), 6) << "only the near pixel is wanted";
  EXPECT_EQ(half.colour(2, 0), near_colour);
  EXPECT_EQ(half.wanted(0, 0), 0);
  EXPECT_EQ(half.wanted(2, 0), 255);
}

TEST(SmallerView, LeavesOutARestAndALargerOneRepeatsWhatIsBesideIt) {
  const Image<Rgb8> colour(5, 3, Rgb8{1, 2, 3});
  const Image<float> disparity(5, 3, -4.f);
  const View view{colour, disparity, {}, left_eye};
  const View half = smaller_view(view, 2);
  EXPECT_EQ(half.colour.width(), 2);
  EXPECT_EQ(half.colour.height(), 1);
  EXPECT_TRUE(half.wanted.empty()) << "all of it";
  const View whole = larger_view(half, 2, 5, 3);
  EXPECT_EQ(whole.frame, ViewFrame());
  EXPECT_EQ(copy_of<Rgb8>(whole.colour), colour);
  EXPECT_EQ(copy_of<float>(whole.disparity), disparity);
}

TEST(View, IsLookedAtInPixelsOfTheReferenceView) {
  const View view = near_columns();
  EXPECT_EQ(disparity_at(view, 8 + 2 * 2.f, 3.9f), 24);
  EXPECT_EQ(disparity_at(view, 8 + 2 * 1.9f, 0), 8);
  EXPECT_EQ(disparity_at(view, -100, 50), 8) << "beyond the border";
}

}  // namespace wheatstone::view_test
