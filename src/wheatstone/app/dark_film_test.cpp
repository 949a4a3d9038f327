// Films that begin in the dark, or go through it.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::dark_film_test {

SyntheticFilmFrame frame_of_film(int frame) {
  SyntheticFilmOptions options{.still = {.width = 240, .height = 136, .samples_a_side = 1}, .frames = 8};
  options.cut = 0;
  return make_synthetic_film_frame(options, frame);
}

/// A still camera's film: only its light changes.
struct LitFilm {
  std::vector<double> brightness;
  Matcher matcher = Matcher::sgbm;
};

StereoPair lit(StereoPair pair, double brightness) {
  for (Image<Rgb8>* picture : {&pair.left, &pair.right}) {
    cv::Mat pixels = as_mat(*picture);
    pixels.convertTo(pixels, -1, brightness);
  }
  return pair;
}

struct PaintedLitFilm {
  std::vector<double> painted_brightness;  ///< mean grey level of the left eye, frame by frame
  double off_share = 0;  ///< of the last frame's left view: disparity off by more than 2 pixels where both eyes see it
};

PaintedLitFilm paint_film(const LitFilm& film) {
  const SyntheticFilmFrame truth = frame_of_film(0);
  RotoscopeState state;
  RotoscopeOptions options;
  options.matching.matcher = film.matcher;
  PaintedLitFilm result;
  for (const double brightness : film.brightness) {
    const RotoscopedFrame frame = rotoscope_frame(lit(truth.pictures, brightness), options, state);
    result.painted_brightness.push_back(cv::mean(as_mat(std::get<StereoPair>(frame.pictures).left))[1]);
  }
  int asked = 0, off = 0;
  const std::span<const float> found = state.left_disparity_before.pixels();
  const std::span<const float> exact = truth.geometry.left_disparity.pixels();
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (truth.geometry.left_occlusion.pixels()[i] != 0) continue;
    ++asked;
    if (!(std::abs(found[i] - exact[i]) <= 2)) ++off;
  }
  result.off_share = static_cast<double>(off) / asked;
  return result;
}

TEST(DarkFilm, GoesOnThroughBlackFrames) {
  for (const Matcher matcher : {Matcher::sgbm, Matcher::census, Matcher::bm}) {
    SCOPED_TRACE(name_of(matcher));
    const PaintedLitFilm film = paint_film({{0, 0, 1, 0, 1}, matcher});
    for (const int black : {0, 1, 3}) EXPECT_LT(film.painted_brightness[black], 5) << black;
    for (const int bright : {2, 4}) EXPECT_GT(film.painted_brightness[bright], 50) << bright;
    EXPECT_LT(film.off_share, paint_film({{1}, matcher}).off_share + 0.02);
  }
}

TEST(DarkFilm, HasItsWholeDepthAfterAFadeIn) {
  const PaintedLitFilm faded = paint_film({{0, 0.02, 0.1, 0.3, 0.6, 1}}), bright = paint_film({{1}});
  RecordProperty("off_share_faded", std::to_string(faded.off_share));
  RecordProperty("off_share_bright", std::to_string(bright.off_share));
  EXPECT_LT(bright.off_share, 0.2);
  EXPECT_LT(faded.off_share, bright.off_share + 0.02);
}

}  // namespace wheatstone::dark_film_test
