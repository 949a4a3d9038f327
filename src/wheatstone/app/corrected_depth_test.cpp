#include "wheatstone/app/corrected_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

#include "scenes/moving_picture.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/random.h"

namespace wheatstone::corrected_depth_test {

constexpr int width = 240, height = 120, step_px = 6, disparity_px = 4, by_hand_px = 9;
constexpr int left_px = 60, right_px = 120;  // columns that are corrected in the first frame

/// A wall that moves to the right.
StereoPair eyes_of_frame(int frame) {
  return {moving_picture(width, height, 0, -step_px * frame),
          moving_picture(width, height, 0, -step_px * frame + disparity_px)};
}

class CorrectedDepth : public testing::TestWithParam<bool> {
 protected:
  CorrectedDepth() {
    options_.matching.range = DisparityRange{0, 16};
    options_.rectify = RectifyPolicy::never;
    options_.at_half_size = GetParam();
    if (GetParam()) options_.style.radii_px = {24, 12}, options_.style.absolute_radii = true;
    Image<float> by_hand(width, height, std::numeric_limits<float>::quiet_NaN());
    for (int y = 0; y < height; ++y)
      for (int x = left_px; x < right_px; ++x) by_hand(x, y) = by_hand_px;
    write_disparity(file_, by_hand);
  }

  /// The disparity in the middle row, in pixels of the film, in column `x` of its frame.
  float disparity_at(int x) const {
    const Image<float>&found = state_.left_disparity_before, &corrected = state_.corrected_disparity;
    const int scale = width / found.width(), column = x / scale, row = found.height() / 2;
    const bool is_found = corrected.empty() || std::isnan(corrected(column, row));
    return (is_found ? found(column, row) : corrected(column, row)) * static_cast<float>(scale);
  }

  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "left_disparity.pfm";
  RotoscopeOptions options_;
  RotoscopeState state_;
};

TEST_P(CorrectedDepth, MovesWithTheFilm) {
  for (int i = 0; i < 4; ++i) {
    options_.maps.disparity = i == 0 ? file_ : std::filesystem::path();
    plan_film_frame(eyes_of_frame(i), options_, state_);
    ASSERT_EQ(state_.left_disparity_before.width(), GetParam() ? width / 2 : width);
    const int from = left_px + step_px * i, to = right_px + step_px * i;
    for (int x = from + 4; x < to - 4; ++x)
      EXPECT_NEAR(disparity_at(x), by_hand_px, 0.01) << "frame " << i << ", " << x;
    for (const int x : {from - 8, to + 12, to + 30}) EXPECT_NEAR(disparity_at(x), disparity_px, 0.5) << i << ", " << x;
  }
}

TEST_P(CorrectedDepth, GivesWayToThatOfALaterFrame) {
  options_.maps.disparity = file_;
  plan_film_frame(eyes_of_frame(0), options_, state_);
  options_.maps.disparity = folder_ / "flat.pfm";
  write_disparity(options_.maps.disparity, Image<float>(width, height, disparity_px));
  plan_film_frame(eyes_of_frame(1), options_, state_);
  EXPECT_NEAR(disparity_at((left_px + right_px) / 2 + step_px), disparity_px, 0.5);
}

TEST_P(CorrectedDepth, OfASceneEndsWithIt) {
  options_.maps.disparity = file_;
  plan_film_frame(eyes_of_frame(0), options_, state_);
  options_.maps.disparity.clear();
  options_.scene_begins = true;
  plan_film_frame(eyes_of_frame(1), options_, state_);
  EXPECT_TRUE(state_.corrected_disparity.empty());
  EXPECT_NEAR(disparity_at((left_px + right_px) / 2 + step_px), disparity_px, 0.5);
}

/// What the eyes see of a red board, perhaps without texture, before a blue wall.
StereoPair board_before_wall(int board_px, bool is_plain) {
  constexpr int first = 100, end = 160;
  StereoPair eyes{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  const auto draw = [&](Image<Rgb8>& eye, int of_board, int of_wall) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool is_board = x + of_board >= first && x + of_board < end;
        const int column = (x + (is_board ? of_board : of_wall)) / 4;
        const auto texture =
            static_cast<std::uint8_t>(hash_keys({static_cast<unsigned>(column), static_cast<unsigned>(y) / 4u}) % 80);
        const Rgb8 of_board_colour{200, is_plain ? std::uint8_t{40} : texture, 20};
        eye(x, y) = is_board ? of_board_colour : Rgb8{20, texture, 200};
      }
  };
  draw(eyes.left, 0, 0);
  draw(eyes.right, board_px, disparity_px);
  return eyes;
}

/// The middle column of what is red.
double middle_of_board(const Image<Rgb8>& eye) {
  double sum = 0, count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (eye(x, y).r > eye(x, y).b) sum += x, ++count;
  return sum / count;
}

TEST_P(CorrectedDepth, MovesAThingInTheRightEye) {
  constexpr int found_px = 8, put_px = 14;
  for (const bool is_plain : {false, true}) {
    state_ = {};
    const StereoPair eyes = board_before_wall(found_px, is_plain), wanted = board_before_wall(put_px, is_plain);
    Image<float> by_hand(width, height, std::numeric_limits<float>::quiet_NaN());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (eyes.left(x, y).r > eyes.left(x, y).b) by_hand(x, y) = put_px;
    write_disparity(file_, by_hand);
    for (int i = 0; i < 4; ++i) {
      options_.maps.disparity = i == 0 ? file_ : std::filesystem::path();
      const RotoscopedFrame frame = rotoscope_frame(eyes, options_, state_);
      const auto& painted = std::get<StereoPair>(frame.pictures);
      EXPECT_NEAR(middle_of_board(painted.left), middle_of_board(wanted.left), 1.5) << i;
      EXPECT_NEAR(middle_of_board(painted.right), middle_of_board(wanted.right), 1.5)
          << i << (is_plain ? ", plain" : "");
    }
  }
}

// The photograph behind the paint moves as the paint does.
TEST_P(CorrectedDepth, MovesAThingOutsideAMask) {
  constexpr int found_px = 8, put_px = 14;
  const StereoPair eyes = board_before_wall(found_px, false), wanted = board_before_wall(put_px, false);
  Image<float> by_hand(width, height, std::numeric_limits<float>::quiet_NaN());
  FrameMask mask{Image<std::uint8_t>(width, height), {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (eyes.left(x, y).r > eyes.left(x, y).b) by_hand(x, y) = put_px;
  write_disparity(file_, by_hand);
  options_.maps.disparity = file_;
  // Nothing is painted: all is the film.
  const RotoscopedFrame frame = rotoscope_frame(eyes, options_, state_, nullptr, {}, &mask);
  EXPECT_NEAR(middle_of_board(std::get<StereoPair>(frame.pictures).right), middle_of_board(wanted.right), 1);
}

INSTANTIATE_TEST_SUITE_P(AtWholeAndHalfSize, CorrectedDepth, testing::Bool());

TEST(DisparityByHand, OfAnotherSizeIsRefused) {
  const TemporaryFolder folder;
  write_disparity(folder / "small.png", Image<float>(8, 4, 1.f));
  expect_error(ErrorKind::bad_input, "small.png: is 8x4 pixels, expected 96x64 as an eye of the film", [&] {
    read_frame_disparity(folder / "small.png", {96, 64});
  });
}

}  // namespace wheatstone::corrected_depth_test
