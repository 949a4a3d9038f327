#include <gtest/gtest.h>

#include "throws_error.h"
#include "wheatstone/motion/flow.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::find_cut_test {

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
    Image<Rgb8> before = left_frame(2, seed);
    for (int i = 3; i < 6; ++i) {
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
  expect_error(ErrorKind::bad_input, "differ in size", [&] { find_cut(darker, Image<Rgb8>(20, 20)); });
}

}  // namespace wheatstone::find_cut_test
