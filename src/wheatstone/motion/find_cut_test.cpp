#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone {
namespace {

Image<Rgb8> left_frame(int number, std::uint64_t seed, float noise = 0) {
  SyntheticFilmOptions options;
  options.still.width = 320;
  options.still.height = 180;
  options.still.samples_a_side = 1;
  options.still.seed = seed;
  options.frames = 8;
  options.cut = 4;
  options.noise = noise;
  return make_synthetic_film_frame(options, number).pictures.left;
}

TEST(FindCut, FindsTheOneOfTheSyntheticFilm) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Image<Rgb8> before = left_frame(0, seed);
    for (int i = 1; i < 8; ++i) {
      const Image<Rgb8> frame = left_frame(i, seed);
      const FrameChange change = find_cut(before, frame);
      EXPECT_EQ(change.cut, i == 4) << "seed " << seed << " frame " << i << " histogram " << change.histogram_distance
                                    << " confirmed " << change.confirmed_share;
      before = frame;
    }
  }
}

TEST(FindCut, NoiseAndAChangeOfLightAreNone) {
  EXPECT_FALSE(find_cut(left_frame(1, 1, 8), left_frame(2, 1, 8)).cut);
  Image<Rgb8> darker = left_frame(2, 1);
  for (Rgb8& pixel : darker.pixels())
    pixel = {static_cast<std::uint8_t>(pixel.r * 4 / 5), static_cast<std::uint8_t>(pixel.g * 4 / 5),
             static_cast<std::uint8_t>(pixel.b * 4 / 5)};
  EXPECT_FALSE(find_cut(left_frame(1, 1), darker).cut);
  expect_error(ErrorKind::bad_input, "sizes", [&] { find_cut(darker, Image<Rgb8>(20, 20)); });
}

TEST(FindCut, AWalkThroughTheStreetsHasNone) {
  const std::filesystem::path path = shared_data() / "video/tokyo_walk_mono.mp4";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  cv::VideoCapture film(path.string());
  ASSERT_TRUE(film.isOpened());
  Image<Rgb8> before;
  for (int i = 0; i < 60; ++i) {
    cv::Mat bgr;
    ASSERT_TRUE(film.read(bgr));
    Image<Rgb8> frame(bgr.cols, bgr.rows);
    cv::Mat rgb = as_mat(frame);
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    if (i > 0) {
      const FrameChange change = find_cut(before, frame);
      EXPECT_FALSE(change.cut) << i;
      EXPECT_GT(change.confirmed_share, 0.9) << i;
    }
    before = std::move(frame);
  }
  // Where a film of the same size is spliced in, there is one.
  Image<Rgb8> other(before.width(), before.height());
  cv::Mat target = as_mat(other);
  cv::resize(as_mat(left_frame(0, 1)), target, target.size());
  EXPECT_TRUE(find_cut(before, other).cut);
}

}  // namespace
}  // namespace wheatstone
