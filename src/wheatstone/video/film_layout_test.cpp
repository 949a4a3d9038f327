#include "wheatstone/video/film_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "throws_error.h"
#include "wheatstone/video/film_layout_internal.h"
#include "wheatstone/video/guess_layout.h"

namespace wheatstone {
namespace {

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

/// Hills of random height at every 12th pixel, smooth between them: nothing repeats.
Image<Rgb8> landscape(int width, int height, int shift, unsigned seed) {
  const auto random = [seed](int i, int j) {
    auto hash =
        static_cast<unsigned>(i) * 2654435761u ^ static_cast<unsigned>(j) * 2246822519u ^ (seed + 1) * 3266489917u;
    hash = (hash ^ hash >> 15) * 2246822519u;
    return static_cast<double>((hash ^ hash >> 13) & 255u);
  };
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int i = (x + shift) / 12, j = y / 12;
      const double u = (x + shift) % 12 / 12.0, v = y % 12 / 12.0;
      const double value = (1 - v) * ((1 - u) * random(i, j) + u * random(i + 1, j)) +
                           v * ((1 - u) * random(i, j + 1) + u * random(i + 1, j + 1));
      picture(x, y) = Rgb8{static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value), 128};
    }
  }
  return picture;
}

int largest_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    most = std::max({most, std::abs(a.pixels()[i].r - b.pixels()[i].r), std::abs(a.pixels()[i].g - b.pixels()[i].g),
                     std::abs(a.pixels()[i].b - b.pixels()[i].b)});
  }
  return most;
}

TEST(FilmLayout, EveryNameAndAliasFindsItsLayout) {
  for (const LayoutTraits& traits : all_layouts()) {
    EXPECT_EQ(film_layout_named(traits.name), traits.layout);
    EXPECT_EQ(film_layout_named(traits.ffmpeg), traits.layout);
    EXPECT_EQ(traits_of(traits.layout).layout, traits.layout) << traits.name << " stands in the wrong line";
  }
  EXPECT_EQ(film_layout_named("side-by-side"), std::nullopt);
  EXPECT_EQ(film_layout_named("ab2r"), FilmLayout::bottom_top_half);
}

TEST(FilmLayout, SplittingUndoesJoining) {
  const Image<Rgb8> left = hills(40, 24, 0), right = hills(40, 24, 6);
  for (const LayoutTraits& traits : all_layouts()) {
    if (traits.arrangement == Arrangement::in_time || traits.arrangement == Arrangement::whole) continue;
    const StereoFrame eyes = split(join(left, right, traits.layout), traits.layout);
    ASSERT_TRUE(same_size(eyes.left, left)) << traits.name;
    // Squeezed eyes come back smooth hills within a few grey levels, and never as each other.
    const int tolerance = traits.half ? 18 : 0;
    EXPECT_LE(largest_difference(eyes.left, left), tolerance) << traits.name;
    EXPECT_LE(largest_difference(eyes.right, right), tolerance) << traits.name;
    EXPECT_GT(largest_difference(eyes.left, right), 40) << traits.name;
  }
}

TEST(FilmLayout, JoiningUndoesSplittingWhereEyesAreWoven) {
  const Image<Rgb8> picture = hills(21, 17, 0);
  for (const FilmLayout layout :
       {FilmLayout::even_odd_rows, FilmLayout::odd_even_rows, FilmLayout::even_odd_columns,
        FilmLayout::odd_even_columns, FilmLayout::checkerboard, FilmLayout::checkerboard_right_first}) {
    const StereoFrame eyes = split(picture, layout);
    EXPECT_EQ(join(eyes.left, eyes.right, layout), picture) << name_of(layout);
  }
}

TEST(FilmLayout, SaysWhereEachEyeLies) {
  const Image<Rgb8> left(4, 2, {255, 0, 0}), right(4, 2, {0, 0, 255});
  const auto first_of = [&](FilmLayout layout) { return join(left, right, layout)(0, 0).r == 255 ? 'l' : 'r'; };
  EXPECT_EQ(first_of(FilmLayout::left_right), 'l');
  EXPECT_EQ(first_of(FilmLayout::right_left), 'r');
  EXPECT_EQ(first_of(FilmLayout::top_bottom_half), 'l');
  EXPECT_EQ(first_of(FilmLayout::bottom_top), 'r');
  EXPECT_EQ(first_of(FilmLayout::odd_even_rows), 'r');
  EXPECT_EQ(first_of(FilmLayout::checkerboard), 'l');
  EXPECT_EQ(join(left, right, FilmLayout::left_right).width(), 8);
  EXPECT_EQ(join(left, right, FilmLayout::top_bottom).height(), 4);
  EXPECT_EQ(join(left, right, FilmLayout::left_right_half).width(), 4);
  EXPECT_TRUE(split(left, FilmLayout::mono).right.empty());
}

TEST(FilmLayout, RefusesWhatCannotBeHalved) {
  expect_error(ErrorKind::bad_input, "41x24 pixels, expected an even width",
               [] { split(Image<Rgb8>(41, 24), FilmLayout::left_right); });
  expect_error(ErrorKind::bad_input, "40x23 pixels, expected an even height",
               [] { split(Image<Rgb8>(40, 23), FilmLayout::top_bottom_half); });
  expect_error(ErrorKind::wrong_usage, "alternating", [] { split(Image<Rgb8>(4, 4), FilmLayout::alternating); });
  expect_error(ErrorKind::wrong_usage, "5x4",
               [] { join(Image<Rgb8>(4, 4), Image<Rgb8>(5, 4), FilmLayout::left_right); });
  expect_error(ErrorKind::wrong_usage, "even width",
               [] { join(Image<Rgb8>(5, 4), Image<Rgb8>(5, 4), FilmLayout::left_right_half); });
}

TEST(GuessLayout, FindsTwoEyesAndTellsSqueezedOnes) {
  const auto guess = [](int width, int height, FilmLayout layout) {
    const std::vector<Image<Rgb8>> frames = {
        join(landscape(width, height, 0, 1), landscape(width, height, 5, 1), layout),
        join(landscape(width, height, 0, 2), landscape(width, height, 5, 2), layout)};
    return guess_layout(frames).layout;
  };
  for (const FilmLayout layout :
       {FilmLayout::left_right, FilmLayout::left_right_half, FilmLayout::top_bottom, FilmLayout::top_bottom_half}) {
    EXPECT_EQ(guess(192, 108, layout), layout) << name_of(layout);
  }
}

TEST(GuessLayout, APlainFilmAndAFlatOneAreMono) {
  const std::vector<Image<Rgb8>> plain = {landscape(192, 108, 0, 1), landscape(192, 108, 0, 2)};
  EXPECT_EQ(guess_layout(plain).layout, FilmLayout::mono) << guess_layout(plain).how;
  const std::vector<Image<Rgb8>> flat(2, Image<Rgb8>(64, 64, {90, 90, 90}));
  EXPECT_EQ(guess_layout(flat).layout, FilmLayout::mono);
  EXPECT_EQ(guess_layout({}).layout, FilmLayout::mono);
}

// What the measure cannot tell, and why the guess is said: a plain film of stripes has two equal halves.
TEST(GuessLayout, IsFooledByARepeatingPattern) {
  Image<Rgb8> stripes(192, 108);
  for (int y = 0; y < 108; ++y) {
    for (int x = 0; x < 192; ++x) stripes(x, y) = (x / 6 + y / 9) % 2 == 0 ? Rgb8{255, 255, 255} : Rgb8{};
  }
  EXPECT_NE(guess_layout(std::array{stripes}).layout, FilmLayout::mono);
}

}  // namespace
}  // namespace wheatstone
