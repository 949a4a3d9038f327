#include "wheatstone/measures/painting_likeness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "throws_error.h"
#include "wheatstone/error.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::painting_likeness_test {

const Image<Rgb8>& photograph() {
  static const Image<Rgb8> picture =
      make_synthetic_still({.width = 320, .height = 240, .samples_a_side = 1}).pictures.left;
  return picture;
}

std::uint8_t brightened(std::uint8_t value, double by) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value + by), 0L, 255L));
}

Image<Rgb8> blurred(const Image<Rgb8>& picture, double deviation_px) {
  Image<Rgb8> result(picture.width(), picture.height());
  cv::GaussianBlur(as_mat(picture), as_mat(result), {}, deviation_px);
  return result;
}

/// Grey noise over a picture.
Image<Rgb8> noisy(Image<Rgb8> picture, double deviation) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, deviation);
  for (Rgb8& pixel : picture.pixels()) {
    const double by = noise(random);
    pixel = {brightened(pixel.r, by), brightened(pixel.g, by), brightened(pixel.b, by)};
  }
  return picture;
}

/// Fine parallel lines over a picture, as bristles leave them.
Image<Rgb8> streaked(Image<Rgb8> picture, double height) {
  for (int y = 0; y < picture.height(); ++y) {
    for (Rgb8& pixel : picture.row(y)) {
      const double by = height * std::sin(2.2 * y);
      pixel = {brightened(pixel.r, by), brightened(pixel.g, by), brightened(pixel.b, by)};
    }
  }
  return picture;
}

TEST(PaintingLikeness, OfThePhotographItselfIsWhole) {
  const PaintingLikeness likeness = measure_likeness(photograph(), photograph());
  EXPECT_DOUBLE_EQ(likeness.gms, 1);
  EXPECT_DOUBLE_EQ(likeness.gms_detail, 1);
  EXPECT_EQ(likeness.lab, 0);
}

TEST(PaintingLikeness, OfALargerPaintingIsThatOfTheReducedOne) {
  Image<Rgb8> large(3 * photograph().width(), 3 * photograph().height());
  cv::resize(as_mat(photograph()), as_mat(large), {large.width(), large.height()}, 0, 0, cv::INTER_NEAREST);
  EXPECT_DOUBLE_EQ(measure_likeness(photograph(), large).gms, 1);
}

TEST(PaintingLikeness, OfAnotherPictureIsLow) {
  Image<Rgb8> mirrored(photograph().width(), photograph().height());
  cv::flip(as_mat(photograph()), as_mat(mirrored), 1);
  const PaintingLikeness likeness = measure_likeness(photograph(), mirrored);
  const PaintingLikeness of_blurred = measure_likeness(photograph(), blurred(photograph(), 1));
  EXPECT_LT(likeness.gms, of_blurred.gms - 0.05);
  EXPECT_LT(likeness.gms_detail, 0.75);
  EXPECT_GT(likeness.lab, 10);
}

TEST(PaintingLikeness, InDetailFallsMoreThanOnTheWholeWhereDetailIsLost) {
  const PaintingLikeness likeness = measure_likeness(photograph(), blurred(photograph(), 3));
  EXPECT_LT(likeness.gms_detail, likeness.gms - 0.05);
}

TEST(PaintingLikeness, MeasuresTheDistanceOfColours) {
  const Image<Rgb8> grey(64, 48, {119, 119, 119}), black(64, 48, {0, 0, 0});
  constexpr double lightness_of_119 = 50.03;  // CIE L* of sRGB 119
  constexpr double of_tables = 0.2;           // OpenCV interpolates in them
  EXPECT_NEAR(measure_likeness(grey, black).lab, lightness_of_119, of_tables);
}

TEST(Grain, OfFlatColourIsNone) {
  const PaintingLikeness likeness = measure_likeness(photograph(), Image<Rgb8>(320, 240, {90, 120, 60}));
  EXPECT_NEAR(likeness.grain, 0, 1e-4);
  EXPECT_EQ(likeness.streaks, 0);
}

TEST(Grain, IsThatOfThePaintAndNotOfThePhotograph) {
  const Image<Rgb8> plain(320, 240, {120, 120, 120});
  EXPECT_NEAR(measure_likeness(noisy(plain, 8), plain).grain, 0, 1e-4);
  EXPECT_GT(measure_likeness(plain, noisy(plain, 8)).grain, 1);
}

TEST(Streaks, AreFewInABlurredPhotographWithNoise) {
  const PaintingLikeness likeness = measure_likeness(photograph(), noisy(blurred(photograph(), 1), 6));
  EXPECT_GT(likeness.gms, 0.85);
  EXPECT_LT(likeness.streaks, 0.25);
}

TEST(Streaks, AreManyWherePaintRunsInOneDirection) {
  EXPECT_GT(measure_likeness(photograph(), streaked(blurred(photograph(), 1), 6)).streaks, 0.8);
}

TEST(PaintingLikeness, RefusesAPaintingOfAnotherShape) {
  expect_error(ErrorKind::bad_input, "the painting is 240x240 pixels, expected the shape of the photograph's 320x240",
               [] { measure_likeness(photograph(), Image<Rgb8>(240, 240)); });
  EXPECT_THROW(measure_likeness(photograph(), {}), Error);
}

TEST(LikenessOfFaces, IsMeasuredInEachBox) {
  Image<Rgb8> half = photograph();
  cv::Mat damaged = as_mat(half)(cv::Rect(160, 0, 160, 240));
  cv::blur(damaged, damaged, {15, 15});
  const std::vector<double> faces = measure_faces(photograph(), half, {{20, 100, 80, 80}, {200, 100, 80, 80}});
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_DOUBLE_EQ(faces[0], 1);
  EXPECT_LT(faces[1], 0.97);
}

}  // namespace wheatstone::painting_likeness_test
