#include "wheatstone/measures/film_measures.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "throws_error.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_measures_test {

SyntheticFilmOptions small(float noise = 0) {
  SyntheticFilmOptions options;
  options.still.width = 320;
  options.still.height = 180;
  options.frames = 6;
  options.cut = 3;
  options.noise = noise;
  return options;
}

std::vector<SyntheticFilmFrame> first_frames(const SyntheticFilmOptions& options, int count) {
  std::vector<SyntheticFilmFrame> film;
  for (int i = 0; i < count; ++i) film.push_back(make_synthetic_film_frame(options, i));
  return film;
}

/// Six frames with a cut before the fourth, without noise.
const std::vector<SyntheticFilmFrame>& small_film() {
  static const std::vector<SyntheticFilmFrame> made = first_frames(small(), small().frames);
  return made;
}

FramePair true_pair(const SyntheticFilmFrame& first, const SyntheticFilmFrame& second) {
  return relate_frames(FlowPair{first.to_next, second.to_previous});
}

TemporalError error_of(const std::vector<SyntheticFilmFrame>& film, const std::vector<SyntheticFilmFrame>& source) {
  TemporalError error;
  for (std::size_t i = 0; i + 1 < film.size(); ++i)
    error.add(film[i].pictures.left, film[i + 1].pictures.left, true_pair(source[i], source[i + 1]));
  return error;
}

/// What noise of deviation 1 adds, per channel: its own square, and that of what bilinear interpolation leaves of it.
double noise_gain(const std::vector<SyntheticFilmFrame>& source) {
  double sum = 0;
  int pairs = 0;
  for (std::size_t i = 0; i + 1 < source.size(); ++i) {
    const FramePair pair = true_pair(source[i], source[i + 1]);
    if (pair.cut) continue;
    double gain = 0;
    int count = 0;
    for (int y = 0; y < pair.mask.height(); ++y) {
      for (int x = 0; x < pair.mask.width(); ++x) {
        if (pair.mask(x, y) == 0) continue;
        const auto left_of = [](float v) {
          const float share = v - std::floor(v);
          return share * share + (1 - share) * (1 - share);
        };
        gain += 1 + left_of(pair.forward.x(x, y)) * left_of(pair.forward.y(x, y));
        ++count;
      }
    }
    sum += gain / count;
    ++pairs;
  }
  return sum / pairs;
}

TEST(FilmMeasures, TheSourceItselfHasAlmostNoErrorAlongItsTrueFlow) {
  const std::vector<SyntheticFilmFrame>& source = small_film();
  const TemporalError error = error_of(source, source);
  EXPECT_EQ(error.pairs(), 4);  // of five, one is the cut
  EXPECT_GT(error.compared_share(), 0.8);
  EXPECT_LT(error.mean(), 1e-3);
  // Without the flow, or along its opposite, it comes out badly.
  TemporalError still, opposite;
  for (std::size_t i = 0; i + 1 < source.size(); ++i) {
    FramePair pair = true_pair(source[i], source[i + 1]);
    for (Image<float>* image : {&pair.forward.x, &pair.forward.y})
      for (float& v : image->pixels()) v = -v;
    opposite.add(source[i].pictures.left, source[i + 1].pictures.left, pair);
    for (Image<float>* image : {&pair.forward.x, &pair.forward.y})
      for (float& v : image->pixels()) v = 0;
    still.add(source[i].pictures.left, source[i + 1].pictures.left, pair);
  }
  EXPECT_GT(still.mean(), 5 * error.mean());
  EXPECT_GT(opposite.mean(), 10 * error.mean());
}

TEST(FilmMeasures, NoiseAFrameAddsWhatItMust) {
  constexpr int frames = 2;
  const std::vector<SyntheticFilmFrame> source(small_film().begin(), small_film().begin() + frames);
  const double clean = error_of(source, source).mean(), gain = noise_gain(source);
  EXPECT_GT(gain, 1.25);
  EXPECT_LT(gain, 2);
  for (const float deviation : {4.f, 8.f}) {
    const double sigma = deviation / 255;
    const double added = error_of(first_frames(small(deviation), frames), source).mean() - clean;
    EXPECT_NEAR(added / (gain * sigma * sigma), 1, 0.08) << deviation;  // some is cut off at black and white
  }
}

TEST(FilmMeasures, NoiseOnAPictureThatStandsStillAddsTwiceItsSquareAChannel) {
  const Image<Rgb8> grey(320, 180, {128, 128, 128});
  Image<Rgb8> first = grey, second = grey;
  // Plus or minus six, at random: of deviation six.
  std::uint32_t state = 1;
  const auto noisy = [&](std::uint8_t v) {
    state = state * 1664525u + 1013904223u;
    return static_cast<std::uint8_t>((state >> 31) != 0 ? v + 6 : v - 6);
  };
  for (Image<Rgb8>* picture : {&first, &second})
    for (Rgb8& pixel : picture->pixels()) pixel = {noisy(pixel.r), noisy(pixel.g), noisy(pixel.b)};
  const Flow still{Image<float>(320, 180), Image<float>(320, 180)};
  const Image<std::uint8_t> all(320, 180, 255);
  const double sigma = 6.0 / 255;
  EXPECT_NEAR(measure_warp_error(first, second, still, all).error, 2 * sigma * sigma, 0.02 * sigma * sigma);
  EXPECT_NEAR(measure_warp_error(first, grey, still, all).error, sigma * sigma, 1e-9);
  EXPECT_EQ(measure_warp_error(grey, grey, still, all).error, 0);
}

TEST(FilmMeasures, CountsOnlyWhatIsMarked) {
  const Image<Rgb8> black(20, 10), white(20, 10, {255, 255, 255});
  Flow flow{Image<float>(20, 10), Image<float>(20, 10)};
  Image<std::uint8_t> mask(20, 10);
  EXPECT_EQ(measure_warp_error(black, white, flow, mask).compared_share, 0);
  mask(3, 3) = 255, mask(4, 3) = 255;
  EXPECT_EQ(measure_warp_error(black, white, flow, mask).error, 1);
  EXPECT_EQ(measure_warp_error(black, white, flow, mask).compared_share, 0.01);
  flow.x(3, 3) = NAN;
  EXPECT_EQ(measure_warp_error(black, white, flow, mask).compared_share, 0.005);
  expect_error(ErrorKind::bad_input, "different sizes",
               [&] { measure_warp_error(black, Image<Rgb8>(20, 9), flow, mask); });
}

TEST(FilmMeasures, TheFlowIsFoundWhereItIsNotGiven) {
  const std::vector<SyntheticFilmFrame>& source = small_film();
  TemporalError estimated;
  for (std::size_t i = 0; i + 1 < source.size(); ++i) {
    const FramePair pair = relate_frames(source[i].pictures.left, source[i + 1].pictures.left);
    EXPECT_EQ(pair.cut, i == 2);
    estimated.add(source[i].pictures.left, source[i + 1].pictures.left, pair);
  }
  EXPECT_EQ(estimated.pairs(), 4);
  EXPECT_LT(estimated.mean(), 1.5 * error_of(source, source).mean());
}

}  // namespace wheatstone::film_measures_test
