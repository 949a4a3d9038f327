#include "wheatstone/video/guess_layout_internal.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::guess_layout_test {

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

TEST(GuessLayout, FindsTwoEyesAndTellsSqueezedOnes) {
  const auto guess = [](int width, int height, StereoLayout layout) {
    const std::vector<Image<Rgb8>> frames = {
        put_together(landscape(width, height, 0, 1), landscape(width, height, 5, 1), layout),
        put_together(landscape(width, height, 0, 2), landscape(width, height, 5, 2), layout)};
    return guess_layout(frames).layout;
  };
  for (const StereoLayout layout : {StereoLayout::left_right, StereoLayout::left_right_half, StereoLayout::top_bottom,
                                    StereoLayout::top_bottom_half}) {
    EXPECT_EQ(guess(192, 108, layout), layout) << layout_name(layout);
  }
}

TEST(GuessLayout, APlainFilmAndAFlatOneAreMono) {
  const std::vector<Image<Rgb8>> plain = {landscape(192, 108, 0, 1), landscape(192, 108, 0, 2)};
  EXPECT_EQ(guess_layout(plain).layout, StereoLayout::mono) << guess_layout(plain).how;
  const std::vector<Image<Rgb8>> flat(2, Image<Rgb8>(64, 64, {90, 90, 90}));
  EXPECT_EQ(guess_layout(flat).layout, StereoLayout::mono);
  EXPECT_EQ(guess_layout({}).layout, StereoLayout::mono);
}

// What the measure cannot tell, and why the guess is said: a plain film of stripes has two equal halves.
TEST(GuessLayout, IsFooledByARepeatingPattern) {
  Image<Rgb8> stripes(192, 108);
  for (int y = 0; y < 108; ++y) {
    for (int x = 0; x < 192; ++x) stripes(x, y) = (x / 6 + y / 9) % 2 == 0 ? Rgb8{255, 255, 255} : Rgb8{};
  }
  EXPECT_NE(guess_layout(std::array{stripes}).layout, StereoLayout::mono);
}

}  // namespace wheatstone::guess_layout_test
