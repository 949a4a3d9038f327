#include "wheatstone/measures/view_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "wheatstone/image/colour.h"

namespace wheatstone::view_measures_test {

/// What is dark enough to stand alone on.
constexpr std::uint8_t backgrounds[] = {0, 3, 9};

struct Splat {
  double x, y;
  float radius_px = 1.2f;  ///< standard deviation
  float light = 0.8f;      ///< at its middle
};

/// Splats 30 pixels apart, each at another place within its pixel.
std::vector<Splat> lone_splats(float radius_px, float light = 0.8f) {
  std::vector<Splat> splats;
  for (int i = 0; i < 12; ++i) {
    const int column = i % 6, row = i / 6;
    splats.push_back({20.5 + 30 * column + 0.31 * i, 30.5 + 50 * row + 0.17 * i, radius_px, light});
  }
  return splats;
}

std::vector<Splat> moved(std::vector<Splat> splats, double x, double y = 0) {
  for (Splat& splat : splats) {
    splat.x += x;
    splat.y += y;
  }
  return splats;
}

/// Linear light of all splats over a background, as a picture.
Image<Rgb8> picture_of(const std::vector<Splat>& splats, Rgb8 background = {}) {
  Image<Rgb8> picture(200, 120);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      float light = 0;
      for (const Splat& splat : splats) {
        const double distance = std::hypot(x + 0.5 - splat.x, y + 0.5 - splat.y) / splat.radius_px;
        light += splat.light * static_cast<float>(std::exp(-distance * distance / 2));
      }
      const auto over = [light](std::uint8_t code) { return srgb_from_linear(linear_from_srgb(code) + light); };
      picture(x, y) = {over(background.r), over(background.g), over(background.b)};
    }
  return picture;
}

TEST(ViewMeasures, EqualPicturesDifferInNothing) {
  const Image<Rgb8> picture = picture_of(lone_splats(1.2f));
  const ViewMeasures measures = measure_view(picture, picture);
  EXPECT_TRUE(std::isinf(measures.psnr_db));
  EXPECT_EQ(measures.differing_pixels, 0u);
  EXPECT_EQ(measures.differing_share, 0);
  EXPECT_EQ(measures.isolated_splats, 12u);
  EXPECT_EQ(measures.lost_splats, 0u);
  EXPECT_EQ(measures.largest_position_error_px, 0);
}

TEST(ViewMeasures, PsnrAndDifferingPixelsAreByTheBook) {
  const Image<Rgb8> reference(10, 10, {100, 100, 100});
  Image<Rgb8> view = reference;
  view(3, 4) = {100, 105, 100};
  view(4, 4) = {96, 100, 100};
  const ViewMeasures measures = measure_view(view, reference);
  EXPECT_NEAR(measures.psnr_db, 10 * std::log10(255. * 255 / ((25. + 16) / 300)), 1e-9);
  EXPECT_EQ(measures.differing_share, 0.02);
  EXPECT_EQ(measures.differing_pixels, 1u);
  EXPECT_EQ(measure_view(view, reference, {.noticeable = 3}).differing_pixels, 2u);
  EXPECT_EQ(measure_view(view, reference, {.noticeable = 5}).differing_pixels, 0u);
}

TEST(ViewMeasures, AShiftIsSeenAsItIs) {
  // Wider or brighter ones reach beyond what may be bright around a splat that stands alone.
  for (const float radius_px : {0.7f, 1.2f})
    for (const float light : {0.06f, 0.8f})
      for (const std::uint8_t background : backgrounds) {
        const Rgb8 around{background, background, background};
        const std::vector<Splat> splats = lone_splats(radius_px, light);
        for (const double shift : {0.25, 0.5, 1.5, 2.5}) {
          const ViewMeasures measures =
              measure_view(picture_of(moved(splats, shift), around), picture_of(splats, around));
          EXPECT_EQ(measures.lost_splats, 0u);
          EXPECT_GT(measures.isolated_splats, 0u) << radius_px << " " << light << " " << +background;
          EXPECT_NEAR(measures.largest_position_error_px, shift, 0.05)
              << "radius " << radius_px << ", light " << light << ", over " << +background;
        }
      }
}

TEST(ViewMeasures, ColourAndDirectionDoNotMatter) {
  const std::vector<Splat> splats = lone_splats(1.2f);
  const auto blue = [](Image<Rgb8> picture) {
    for (Rgb8& pixel : picture.pixels()) pixel.r = pixel.g = 0;
    return picture;
  };
  const ViewMeasures measures = measure_view(blue(picture_of(moved(splats, -0.9, 1.2))), blue(picture_of(splats)));
  EXPECT_EQ(measures.isolated_splats, 12u);
  EXPECT_NEAR(measures.largest_position_error_px, 1.5, 0.05);
}

TEST(ViewMeasures, OneThatIsOffIsTheWorst) {
  const std::vector<Splat> splats = lone_splats(1.2f);
  std::vector<Splat> off = moved(splats, 0.2);
  off[7].x += 0.7;
  const ViewMeasures measures = measure_view(picture_of(off), picture_of(splats));
  EXPECT_NEAR(measures.largest_position_error_px, 0.9, 0.05);
}

TEST(ViewMeasures, WhatIsMissingIsLost) {
  for (const std::uint8_t background : backgrounds) {
    const Rgb8 around{background, background, background};
    const std::vector<Splat> splats = lone_splats(1.2f, 0.1f);
    std::vector<Splat> fewer = splats;
    fewer.erase(fewer.begin() + 5);
    const ViewMeasures measures = measure_view(picture_of(fewer, around), picture_of(splats, around));
    EXPECT_EQ(measures.isolated_splats, 12u);
    EXPECT_EQ(measures.lost_splats, 1u) << "over " << +background;
    EXPECT_EQ(measures.largest_position_error_px, 0);
  }
}

TEST(ViewMeasures, WhatIsFarOffOrNearlyDarkIsLost) {
  const std::vector<Splat> splats = lone_splats(1.2f);
  EXPECT_EQ(measure_view(picture_of(moved(splats, 3.4)), picture_of(splats)).lost_splats, 12u);
  EXPECT_EQ(measure_view(picture_of(moved(splats, 6)), picture_of(splats)).lost_splats, 12u);
  EXPECT_EQ(measure_view(picture_of(lone_splats(1.2f, 0.1f)), picture_of(splats)).lost_splats, 12u);
}

TEST(ViewMeasures, SplatsInACrowdAreNotTakenForLoneOnes) {
  std::vector<Splat> splats = lone_splats(1.2f);
  const std::vector<Splat> neighbours = moved(splats, 7, 2);
  splats.insert(splats.end(), neighbours.begin(), neighbours.end());
  EXPECT_EQ(measure_view(picture_of(splats), picture_of(splats)).isolated_splats, 0u);
}

TEST(ViewMeasures, SmallPicturesAreMeasuredToo) {
  const Image<Rgb8> black(1, 1), white(1, 1, {255, 255, 255});
  const ViewMeasures measures = measure_view(white, black);
  EXPECT_EQ(measures.psnr_db, 0);
  EXPECT_EQ(measures.differing_pixels, 1u);
  EXPECT_EQ(measures.isolated_splats, 0u);
}

}  // namespace wheatstone::view_measures_test
