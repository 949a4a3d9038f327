// The matcher for photographs: from coarse to fine, whatever sensors and exposures do, and filled without streaks.

#include "wheatstone/matching/coarse_to_fine_internal.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "scenes/still_life.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/fill_in_picture_internal.h"
#include "wheatstone/random.h"

namespace wheatstone::coarse_to_fine_test {

const SyntheticStill& still() { return still_life(320, 240); }

/// A picture from a poorer camera: darker, and with noise of its own, ±`noise` levels.
Image<Rgb8> from_poor_camera(const Image<Rgb8>& picture, double exposure, float noise, std::uint64_t seed) {
  Image<Rgb8> result = picture;
  const auto spoiled = [&](std::uint8_t value, std::uint64_t at) {
    const float jitter = noise * (2 * unit_float(hash_keys({seed, at})) - 1);
    return static_cast<std::uint8_t>(std::clamp(exposure * value + static_cast<double>(jitter), 0.0, 255.0));
  };
  for (std::size_t i = 0; i < result.pixels().size(); ++i) {
    Rgb8& pixel = result.pixels()[i];
    pixel = {spoiled(pixel.r, 3 * i), spoiled(pixel.g, 3 * i + 1), spoiled(pixel.b, 3 * i + 2)};
  }
  return result;
}

double bad_2(const Image<float>& found) {
  const StereoGeometry& truth = still().geometry;
  double asked = 0, bad = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i) {
    if (truth.left_occlusion.pixels()[i] != 0) continue;
    ++asked;
    bad += std::abs(found.pixels()[i] - truth.left_disparity.pixels()[i]) <= 2 ? 0 : 1;
  }
  return bad / asked;
}

/// Share of wrong pixels with the right picture's exposure and both pictures' noise, by our matcher and OpenCV's.
std::array<double, 2> bad_2_of_poor_pictures(double exposure, float noise) {
  const StereoPair poor{from_poor_camera(still().pictures.left, 1, noise, 1),
                        from_poor_camera(still().pictures.right, exposure, noise, 2)};
  MatchOptions naive;
  naive.matcher = Matcher::sgbm;
  return {bad_2(match(poor).geometry.left_disparity), bad_2(match(poor, naive).geometry.left_disparity)};
}

TEST(CoarseToFine, UnlikeExposureCostsHardlyAnything) {
  const auto [ours, naive] = bad_2_of_poor_pictures(0.8, 0);
  const auto [alike, unused] = bad_2_of_poor_pictures(1, 0);
  EXPECT_LT(ours, alike + 0.005);  // reached: .033 and .032
  EXPECT_LT(ours, 0.6 * naive);    // reached: .033 and .069
}

TEST(CoarseToFine, NoiseCostsLessThanInBlocks) {
  const auto [ours, naive] = bad_2_of_poor_pictures(0.8, 7);
  EXPECT_LT(ours, 0.8 * naive);  // reached: .176 and .237
}

TEST(CoarseToFine, IsTheSameOnAnyNumberOfThreads) {
  const StereoPair& pair = still().pictures;
  const DisparityRange range{0, 40};
  const CheckedMatch many = match_coarse_to_fine(as_mat(pair.left), as_mat(pair.right), range, {});
  cv::setNumThreads(7);  // some of OpenCV's filters divide the rows by them
  const CheckedMatch divided = match_coarse_to_fine(as_mat(pair.left), as_mat(pair.right), range, {});
  cv::setNumThreads(-1);
  EXPECT_TRUE(std::ranges::equal(many.left.pixels(), divided.left.pixels()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const CheckedMatch alone = match_coarse_to_fine(as_mat(pair.left), as_mat(pair.right), range, {});
  EXPECT_TRUE(std::ranges::equal(many.left.pixels(), alone.left.pixels()));
}

TEST(CoarseToFine, LargePicturesAreMatchedNearWhatTheirSmallCopiesHave) {
  // Wide enough for three sizes.
  constexpr int factor = 6;
  cv::Mat left, right;
  cv::resize(as_mat(still().pictures.left), left, {}, factor, factor, cv::INTER_CUBIC);
  cv::resize(as_mat(still().pictures.right), right, {}, factor, factor, cv::INTER_CUBIC);
  const CheckedMatch match = match_coarse_to_fine(left, right, {0, 40 * factor}, {});
  Image<float> small(still().pictures.left.width(), still().pictures.left.height());
  for (int y = 0; y < small.height(); ++y)
    for (int x = 0; x < small.width(); ++x)
      small(x, y) = match.left(x * factor + factor / 2, y * factor + factor / 2) / factor;
  EXPECT_LT(bad_2(small), 0.06);
}

TEST(FillInPicture, ThePlainGoesOnAndTheHiddenIsFar) {
  constexpr int width = 120, height = 80;
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  // A slanted ground, a hole in it, and a near box with what it hides to its left.
  Image<float> disparity(width, height), right(width, height, unknown);
  cv::Mat picture(height, width, CV_8UC3, cv::Scalar(90, 120, 60));
  const auto ground = [](int y) { return 5 + 0.05f * static_cast<float>(y); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) disparity(x, y) = ground(y);
  const cv::Rect box(80, 20, 25, 40);
  picture(box).setTo(cv::Scalar(200, 40, 40));
  for (int y = box.y; y < box.br().y; ++y) {
    for (int x = box.x; x < box.br().x; ++x) disparity(x, y) = 15;
    for (int x = box.x - 10; x < box.x; ++x) disparity(x, y) = unknown;
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float d = disparity(x, y);
      const int there = std::isfinite(d) ? x - static_cast<int>(std::lround(d)) : -1;
      if (there >= 0 && !(right(there, y) > d)) right(there, y) = d;
    }
  }
  for (int y = 30; y < 50; ++y)
    for (int x = 25; x < 50; ++x) disparity(x, y) = unknown;
  fill_in_picture(disparity, right, {picture, cv::Mat::zeros(picture.size(), CV_8U)});
  for (int y = 30; y < 50; ++y)
    for (int x = 25; x < 50; ++x) ASSERT_NEAR(disparity(x, y), ground(y), 0.5) << x << " " << y;
  for (int y = box.y; y < box.br().y; ++y)
    for (int x = box.x - 10; x < box.x; ++x) ASSERT_NEAR(disparity(x, y), ground(y), 1) << x << " " << y;
}

}  // namespace wheatstone::coarse_to_fine_test
