#include "wheatstone/stereo/packed_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "largest_difference.h"
#include "throws_error.h"

namespace wheatstone::packed_pair_test {

/// Smooth waves; `shift` moves them to the left, as for the right eye.
Image<Rgb8> hills(int width, int height, double shift) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = x + shift, v = y;
      const double height_here = std::sin(u * 0.21) * std::cos(v * 0.17) + std::sin(u * 0.053 * (1 + v * 0.01));
      const auto value = static_cast<std::uint8_t>(128 + 60 * height_here);
      picture(x, y) = {value, static_cast<std::uint8_t>(255 - value), static_cast<std::uint8_t>(value / 2)};
    }
  }
  return picture;
}

StereoLayout first_eye_right(StereoLayout layout, bool right) { return right ? with_eyes_swapped(layout) : layout; }

TEST(PackedPair, CuttingApartUndoesPuttingTogether) {
  const Image<Rgb8> left = hills(40, 24, 0), right = hills(40, 24, 6);
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (!is_packed(traits.layout)) continue;
    const StereoPair eyes = cut_apart(put_together(left, right, traits.layout), traits.layout, "it");
    ASSERT_TRUE(same_size(eyes.left, left)) << traits.name;
    // Squeezed eyes come back smooth hills within a few grey levels, and never as each other.
    const int tolerance = traits.half ? 18 : 0;
    EXPECT_LE(largest_difference(eyes.left, left), tolerance) << traits.name;
    EXPECT_LE(largest_difference(eyes.right, right), tolerance) << traits.name;
    EXPECT_GT(largest_difference(eyes.left, right), 40) << traits.name;
  }
}

TEST(PackedPair, PuttingTogetherUndoesCuttingApartWhereEyesAreWoven) {
  const Image<Rgb8> picture = hills(21, 17, 0);
  for (const LayoutTraits& traits : stereo_layouts()) {
    const bool in_halves =
        traits.arrangement == Arrangement::side_by_side || traits.arrangement == Arrangement::over_under;
    if (in_halves || !is_packed(traits.layout)) continue;
    const StereoPair eyes = cut_apart(picture, traits.layout, "it");
    EXPECT_EQ(put_together(eyes.left, eyes.right, traits.layout), picture) << traits.name;
  }
}

TEST(PackedPair, IsTheSameWithSixteenBits) {
  const StereoPair eyes{hills(24, 16, 0), hills(24, 16, 6)};
  const auto deepened = [](const Image<Rgb8>& picture) {
    Image<Rgb16> deep(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), deep.pixels().begin(), [](Rgb8 level) {
      const auto code = [](std::uint8_t channel) { return static_cast<std::uint16_t>(channel * deep_level); };
      return Rgb16{code(level.r), code(level.g), code(level.b)};
    });
    return deep;
  };
  for (const StereoLayout layout : {StereoLayout::left_right, StereoLayout::bottom_top, StereoLayout::checkerboard,
                                    StereoLayout::left_right_half}) {
    const Image<Rgb16> packed = put_together(deepened(eyes.left), deepened(eyes.right), layout);
    const Image<Rgb8> expected = put_together(eyes.left, eyes.right, layout);
    ASSERT_TRUE(same_size(packed, expected));
    for (std::size_t i = 0; i < packed.pixels().size(); ++i)
      EXPECT_NEAR(static_cast<double>(packed.pixels()[i].g) / deep_level, expected.pixels()[i].g, 0.51) << i;
    const auto [left, right] = cut_apart(packed, layout, "a frame");
    const StereoPair cut = cut_apart(expected, layout, "a frame");
    for (std::size_t i = 0; i < left.pixels().size(); ++i) {
      EXPECT_NEAR(static_cast<double>(left.pixels()[i].r) / deep_level, cut.left.pixels()[i].r, 1.5) << i;
      EXPECT_NEAR(static_cast<double>(right.pixels()[i].r) / deep_level, cut.right.pixels()[i].r, 1.5) << i;
    }
  }
}

TEST(PackedPair, EachPixelOfAnInterlacedScreenShowsItsEye) {
  const Image<Rgb8> left(5, 3, {255, 0, 0}), right(5, 3, {0, 0, 255});
  const auto shown = [&](StereoLayout layout) {
    const Image<Rgb8> picture = put_together(left, right, layout);
    std::string pattern;
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 5; ++x) pattern += picture(x, y).r == 255 ? 'L' : 'R';
      pattern += ' ';
    }
    return pattern;
  };
  EXPECT_EQ(shown(StereoLayout::even_odd_rows), "LLLLL RRRRR LLLLL ");
  EXPECT_EQ(shown(StereoLayout::odd_even_rows), "RRRRR LLLLL RRRRR ");
  EXPECT_EQ(shown(StereoLayout::even_odd_columns), "LRLRL LRLRL LRLRL ");
  EXPECT_EQ(shown(StereoLayout::checkerboard), "LRLRL RLRLR LRLRL ");
  EXPECT_EQ(shown(StereoLayout::checkerboard_right_first), "RLRLR LRLRL RLRLR ");
}

TEST(PackedPair, PixelsOfAnInterlacedScreenStayWhereTheyAre) {
  Image<Rgb8> left(7, 5), right(7, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      left(x, y) = {std::uint8_t(x), std::uint8_t(y), 0};
      right(x, y) = {std::uint8_t(x), std::uint8_t(y), 1};
    }
  for (const StereoLayout layout :
       {StereoLayout::even_odd_rows, StereoLayout::odd_even_columns, StereoLayout::checkerboard}) {
    const Image<Rgb8> picture = put_together(left, right, layout);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 7; ++x) {
        EXPECT_EQ(picture(x, y).r, x);
        EXPECT_EQ(picture(x, y).g, y);
      }
  }
}

TEST(PackedPair, EyesLieInHalvesAsTheLayoutSays) {
  const Image<Rgb8> left(4, 2, {255, 0, 0}), right(4, 2, {0, 0, 255});
  const auto first_of = [&](StereoLayout layout) { return put_together(left, right, layout)(0, 0).r == 255; };
  for (const bool swapped : {false, true}) {
    EXPECT_NE(first_of(first_eye_right(StereoLayout::left_right, swapped)), swapped);
    EXPECT_NE(first_of(first_eye_right(StereoLayout::top_bottom_half, swapped)), swapped);
  }
  EXPECT_EQ(put_together(left, right, StereoLayout::left_right).width(), 8);
  EXPECT_EQ(put_together(left, right, StereoLayout::top_bottom).height(), 4);
  EXPECT_EQ(put_together(left, right, StereoLayout::left_right_half).width(), 4);
  EXPECT_EQ(put_together(left, right, StereoLayout::mono), left);
  // An odd number of columns: the last stays alone.
  EXPECT_EQ(put_together(Image<Rgb8>(5, 4), Image<Rgb8>(5, 4), StereoLayout::left_right_half).width(), 6);
}

// Quarters of four colours tell every layout apart.
TEST(PackedPair, IsCutApartIntoLeftAndRight) {
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

TEST(PackedPair, ThatDoesNotHalveEvenlyOrIsInTwoPicturesIsRefused) {
  expect_error(ErrorKind::bad_input, "a.png: is 7x4 pixels, expected an even width",
               [] { cut_apart(Image<Rgb8>(7, 4), StereoLayout::left_right, "a.png"); });
  expect_error(ErrorKind::bad_input, "a.png: is 8x5 pixels, expected an even height",
               [] { cut_apart(Image<Rgb8>(8, 5), StereoLayout::bottom_top_half, "a.png"); });
  expect_error(ErrorKind::wrong_usage, "'alternating' (one frame after the other",
               [] { cut_apart(Image<Rgb8>(4, 4), StereoLayout::alternating, "a.png"); });
  expect_error(ErrorKind::wrong_usage, "'mono' (one eye) does not hold both eyes",
               [] { cut_apart(Image<Rgb8>(4, 4), StereoLayout::mono, "a.png"); });
  for (const StereoLayout layout : {StereoLayout::left_right, StereoLayout::checkerboard})
    expect_error(ErrorKind::wrong_usage, "4x4 and 5x4",
                 [&] { put_together(Image<Rgb8>(4, 4), Image<Rgb8>(5, 4), layout); });
}

}  // namespace wheatstone::packed_pair_test
