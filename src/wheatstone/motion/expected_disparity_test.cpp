// The disparity of films, found near where the frame before and the flow let it be expected.

#include "wheatstone/motion/expected_disparity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/matching/match_near.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::expected_disparity_test {

TEST(ExpectedDisparity, MovesWithTheFlow) {
  Image<float> before(8, 4, 1);
  before(6, 1) = 5;
  const Flow to_before{Image<float>(4, 2, 1), Image<float>(4, 2, -0.5f)};  // of a copy of half the size
  const Image<float> expected = expected_disparity(before, to_before, 8, 4);
  EXPECT_EQ(expected(4, 2), 5);
  EXPECT_EQ(expected(3, 2), 1);
  EXPECT_TRUE(std::isnan(expected(7, 2))) << "the flow leads out of the picture";
}

TEST(StillPlaces, AreWhereTheFlowIsShort) {
  Flow to_before{Image<float>(4, 2, 0.2f), Image<float>(4, 2, 0.1f)};  // of frames of twice the size
  to_before.x(1, 0) = -0.3f;
  const Image<std::uint8_t> still = still_places(to_before, 8, 8, 4);
  EXPECT_EQ(still(0, 0), 255);
  EXPECT_EQ(still(2, 0), 0);
  EXPECT_EQ(still(3, 1), 0);
  EXPECT_EQ(still(3, 2), 255);
}

constexpr int width = 240, height = 136;

std::vector<SyntheticFilmFrame> film_of(FilmScene scene) {
  SyntheticFilmOptions options{.still = {.width = width, .height = height, .samples_a_side = 1}, .frames = 24};
  options.cut = 0;
  options.scene = scene;
  std::vector<SyntheticFilmFrame> film;
  for (int frame = 0; frame < 2; ++frame) film.push_back(make_synthetic_film_frame(options, 8 + frame));
  return film;
}

/// Mean error in pixels; no pixel counts for more than 8.
double mean_error(const Image<float>& found, const Image<float>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < found.pixels().size(); ++i)
    sum += std::min(std::abs(found.pixels()[i] - truth.pixels()[i]), 8.f);
  return sum / static_cast<double>(found.pixels().size());
}

void expect_as_good_as_alone(const std::vector<SyntheticFilmFrame>& film) {
  MatchOptions options{.matcher = Matcher::sgbm};
  options.range = find_disparity_range(film.front().pictures);
  Image<float> disparity = match(film.front().pictures, options).geometry.left_disparity;
  for (std::size_t i = 1; i < film.size(); ++i) {
    const FrameChange change = find_cut(film[i - 1].pictures.left, film[i].pictures.left);
    disparity = match_near(film[i].pictures, expected_disparity(disparity, change.flow.backward, width, height),
                           options, still_places(change.flow.backward, width, width, height))
                    ->geometry.left_disparity;
  }
  const Image<float>& truth = film.back().geometry.left_disparity;
  EXPECT_LE(mean_error(disparity, truth),
            mean_error(match(film.back().pictures, options).geometry.left_disparity, truth));
}

TEST(ExpectedDisparity, LeadsToOneAsGoodAsFoundInEachFrameAlone) {
  expect_as_good_as_alone(film_of(FilmScene::beams));
  expect_as_good_as_alone(film_of(FilmScene::crowd));
}

}  // namespace wheatstone::expected_disparity_test
