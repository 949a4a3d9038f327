// A film whose eyes' rows differ.

#include "wheatstone/app/scene_rectification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::scene_rectification_test {

constexpr int film_width = 320, film_height = 180;

/// A frame by eyes that stand straight.
const StereoPair& straight_frame(int frame) {
  static std::map<int, StereoPair> made;
  const auto [at, is_new] = made.try_emplace(frame);
  const SyntheticFilmOptions options{
      .still = {.width = film_width, .height = film_height, .samples_a_side = 1}, .frames = 12, .cut = 0};
  if (is_new) at->second = make_synthetic_film_frame(options, frame).pictures;
  return at->second;
}

StereoPair film_frame(int frame, double right_turn_degrees) {
  StereoPair pair = straight_frame(frame);
  if (right_turn_degrees == 0) return pair;
  const cv::Point2f middle(film_width / 2.f, film_height / 2.f);
  cv::Mat turned;
  cv::warpAffine(as_mat(pair.right), turned, cv::getRotationMatrix2D(middle, right_turn_degrees, 1),
                 {film_width, film_height}, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  turned.copyTo(as_mat(pair.right));
  return pair;
}

struct PaintedFilm {
  double survival = 0, temporal_error = 0;
  bool rectified = false;
  std::string note;
};

PaintedFilm paint_film(double right_turn_degrees, int frames, RectifyPolicy policy = RectifyPolicy::automatic) {
  RotoscopeState state;
  RotoscopeOptions options;
  options.rectify = policy;
  PaintedFilm film;
  TemporalError error;
  Image<Rgb8> source, painted;
  for (int i = 0; i < frames; ++i) {
    const StereoPair eyes = film_frame(i, right_turn_degrees);
    const RotoscopedFrame frame = rotoscope_frame(eyes, options, state);
    if (!frame.rows_note.empty()) film.note = frame.rows_note;
    EXPECT_EQ(frame.scene_begins, i == 0) << i;
    const Image<Rgb8> rectified_source = rectified(eyes, state.rectification).left;
    if (i > 0) error.add(painted, std::get<StereoPair>(frame.pictures).left, relate_frames(source, rectified_source));
    source = rectified_source;
    painted = std::get<StereoPair>(frame.pictures).left;
  }
  film.rectified = state.rectification.how.has_value();
  film.survival = static_cast<double>(state.totals.survived_strokes) / static_cast<double>(state.totals.whole_strokes);
  film.temporal_error = error.mean();
  return film;
}

TEST(SceneRectification, MakesATurnedEyesFilmAsSteadyAsAStraightOnes) {
  const PaintedFilm straight = paint_film(0, 3), turned = paint_film(1, 3);
  EXPECT_FALSE(straight.rectified);
  EXPECT_TRUE(turned.rectified);
  EXPECT_THAT(turned.note, testing::HasSubstr("rectified"));
  EXPECT_NEAR(turned.survival, straight.survival, 0.1 * straight.survival);
  EXPECT_LT(turned.temporal_error, 1.1 * straight.temporal_error);
  RecordProperty("survival_straight", std::to_string(straight.survival));
  RecordProperty("survival_turned", std::to_string(turned.survival));
  RecordProperty("temporal_error_straight", std::to_string(straight.temporal_error));
  RecordProperty("temporal_error_turned", std::to_string(turned.temporal_error));
}

TEST(SceneRectification, IsToldAndLeftOutOnDemand) {
  const PaintedFilm film = paint_film(1, 1, RectifyPolicy::never);
  EXPECT_FALSE(film.rectified);
  EXPECT_THAT(film.note, testing::HasSubstr("not rectified"));
}

TEST(SceneRectification, IsFoundLaterWhereASceneBeginsInTheDark) {
  const StereoPair dark{Image<Rgb8>(film_width, film_height), Image<Rgb8>(film_width, film_height)};
  EXPECT_FALSE(measure_scene(dark, RectifyPolicy::automatic).rectification.measured);
  RotoscopeState state;
  rotoscope_frame(film_frame(0, 0), {}, state);
  state.rectification = {};
  state.frames_of_scene = 24;
  const RotoscopedFrame frame = rotoscope_frame(film_frame(1, 1), {}, state);
  EXPECT_TRUE(state.rectification.how);
  EXPECT_TRUE(frame.scene_begins);
}

TEST(SceneRectification, IsKeptForGoingOn) {
  RotoscopeState state;
  rotoscope_frame(film_frame(0, 1), {}, state);
  ASSERT_TRUE(state.rectification.how);
  RotoscopeState read = decode_rotoscope_state(encode_rotoscope_state(state), "state");
  ASSERT_TRUE(read.rectification.how);
  EXPECT_EQ(read.rectification.how->right.homography, state.rectification.how->right.homography);
  EXPECT_EQ(read.rectification.how->left.straightening, state.rectification.how->left.straightening);
  const StereoPair next = film_frame(1, 1);
  EXPECT_EQ(rectified(next, read.rectification).right, rectified(next, state.rectification).right);
}

}  // namespace wheatstone::scene_rectification_test
