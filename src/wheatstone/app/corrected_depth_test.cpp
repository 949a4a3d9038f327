#include "wheatstone/app/corrected_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenes/moving_picture.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/pictures/disparity_file.h"

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
    const Image<float>& found = state_.left_disparity_before;
    const int scale = width / found.width();
    return found(x / scale, found.height() / 2) * static_cast<float>(scale);
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

INSTANTIATE_TEST_SUITE_P(AtWholeAndHalfSize, CorrectedDepth, testing::Bool());

TEST(DisparityByHand, OfAnotherSizeIsRefused) {
  const TemporaryFolder folder;
  write_disparity(folder / "small.png", Image<float>(8, 4, 1.f));
  expect_error(ErrorKind::bad_input, "small.png: is 8x4 pixels, expected 96x64 as an eye of the film", [&] {
    read_frame_disparity(folder / "small.png", {96, 64});
  });
}

}  // namespace wheatstone::corrected_depth_test
