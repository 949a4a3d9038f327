#include "wheatstone/share/share_pictures.h"

#include <gmock/gmock.h>

#include "wheatstone/error.h"

namespace wheatstone::share_slices_test {

/// Planes of speckled light, of which no two pixels are alike.
SliceStack speckled_stack(int width, int height) {
  SliceStack stack{.width = width, .height = height};
  unsigned state = 1;
  for (const float parallax_px : {-2.f, 1.f}) {
    Slice slice{.parallax_px = parallax_px, .pixels = Image<LinearRgba>(width, height)};
    for (LinearRgba& pixel : slice.pixels.pixels()) {
      state = state * 1664525u + 1013904223u;
      pixel.r = pixel.g = pixel.b = static_cast<float>(state >> 8) / 1e7f;
    }
    stack.slices.push_back(std::move(slice));
  }
  return stack;
}

TEST(ShareSlices, StaysBelowTheSizeThatIsWantedAndTellsWhatGaveWay) {
  const SliceStack stack = speckled_stack(256, 160);
  const SharedPicture whole = share_slices(stack, {});
  EXPECT_EQ(whole.note, "");
  EXPECT_EQ(whole.width, 256);

  const std::size_t most_bytes = page_bytes(whole) - 1000;
  const SharedPicture smaller = share_slices(stack, {.most_bytes = most_bytes});
  EXPECT_LE(html_page(smaller, {}).size(), most_bytes);
  EXPECT_THAT(smaller.note, testing::HasSubstr("rounded to 127 steps"));

  const SharedPicture half = share_slices(stack, {.most_bytes = page_bytes(whole) / 2});
  EXPECT_LE(html_page(half, {}).size(), page_bytes(whole) / 2);
  EXPECT_THAT(half.note, testing::HasSubstr("128x80 pixels"));
}

TEST(ShareSlices, RefusesNothing) { EXPECT_THROW(share_slices({}, {}), Error); }

}  // namespace wheatstone::share_slices_test
