#include "wheatstone/stereo/stereo_layout.h"

#include <gtest/gtest.h>

#include "throws_error.h"

namespace wheatstone {
namespace {

TEST(StereoLayout, IsKnownByItsNamesAndAliases) {
  for (const std::string_view name : layout_names()) EXPECT_EQ(layout_name(layout_by_name(name)), name);
  EXPECT_EQ(layout_names().size(), 8u);
  EXPECT_EQ(layout_by_name("sbs"), StereoLayout::left_right);
  EXPECT_EQ(layout_by_name("sbsl"), StereoLayout::left_right);
  EXPECT_EQ(layout_by_name("cross-eyed"), StereoLayout::right_left);
  EXPECT_EQ(layout_by_name("tb"), StereoLayout::top_bottom);
  EXPECT_EQ(layout_by_name("abl"), StereoLayout::top_bottom);
}

TEST(StereoLayout, OfAnAnaglyphOrOfNoKindIsRefused) {
  expect_error(ErrorKind::wrong_usage, "each eye kept only some of its colours", [] { layout_by_name("anaglyph"); });
  expect_error(ErrorKind::wrong_usage, "left-right, left-right-half, right-left", [] { layout_by_name("checkers"); });
}

TEST(StereoLayout, SwapsAndSqueezesWithoutChangingTheRest) {
  for (const std::string_view name : layout_names()) {
    const StereoLayout layout = layout_by_name(name);
    EXPECT_NE(is_left_first(with_eyes_swapped(layout)), is_left_first(layout));
    EXPECT_EQ(with_eyes_swapped(with_eyes_swapped(layout)), layout);
    EXPECT_TRUE(is_half_size(with_half_size(layout, true)));
    EXPECT_EQ(with_half_size(layout, is_half_size(layout)), layout);
    EXPECT_EQ(is_side_by_side(with_eyes_swapped(layout)), is_side_by_side(layout));
  }
}

// Quarters of four colours tell every layout apart.
TEST(StereoLayout, IsCutApartIntoLeftAndRight) {
  const Rgb8 nw{200, 0, 0}, ne{0, 200, 0}, sw{0, 0, 200}, se{90, 90, 90};
  Image<Rgb8> picture(8, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) picture(x, y) = y < 2 ? (x < 4 ? nw : ne) : (x < 4 ? sw : se);
  for (const bool half : {false, true}) {
    SCOPED_TRACE(half);
    const auto cut = [&](StereoLayout layout) { return cut_apart(picture, with_half_size(layout, half), "a.png"); };
    const StereoPair sideways = cut(StereoLayout::left_right), crossed = cut(StereoLayout::right_left);
    EXPECT_EQ(sideways.left(0, 0), nw);
    EXPECT_EQ(sideways.right(0, 0), ne);
    EXPECT_EQ(crossed.left, sideways.right);
    EXPECT_EQ(crossed.right, sideways.left);
    EXPECT_EQ(sideways.left.width(), half ? 8 : 4);
    EXPECT_EQ(sideways.left.height(), 4);
    const StereoPair above = cut(StereoLayout::top_bottom), below = cut(StereoLayout::bottom_top);
    EXPECT_EQ(above.left(0, 0), nw);
    EXPECT_EQ(above.right(0, 0), sw);
    EXPECT_EQ(below.left, above.right);
    EXPECT_EQ(above.left.width(), 8);
    EXPECT_EQ(above.left.height(), half ? 4 : 2);
  }
}

TEST(StereoLayout, ThatDoesNotHalveEvenlyIsRefused) {
  expect_error(ErrorKind::bad_input, "a.png: is 7x4 pixels, expected an even width",
               [] { cut_apart(Image<Rgb8>(7, 4), StereoLayout::left_right, "a.png"); });
  expect_error(ErrorKind::bad_input, "a.png: is 8x5 pixels, expected an even height",
               [] { cut_apart(Image<Rgb8>(8, 5), StereoLayout::bottom_top_half, "a.png"); });
}

}  // namespace
}  // namespace wheatstone
