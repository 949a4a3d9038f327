// Films that are planned at half their size.

#include <gtest/gtest.h>

#include "psnr.h"
#include "temporary_folder.h"
#include "wheatstone/app/half_size_internal.h"
#include "wheatstone/app/rotoscope.h"
#include "wheatstone/app/rotoscope_state_file_internal.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::half_size_test {

constexpr int frames = 4;

SyntheticFilmFrame film_frame(int frame) {
  SyntheticFilmOptions options;
  options.still.width = 191;  // the last column has no neighbour
  options.still.height = 108;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = 0;
  return make_synthetic_film_frame(options, frame);
}

RotoscopeOptions options_of(bool at_half_size) {
  RotoscopeOptions options;
  options.style.radii_px = {40, 20, 11};  // for a picture 640 pixels wide
  options.at_half_size = at_half_size;
  return options;
}

struct PaintedFilm {
  std::vector<RotoscopedFrame> frames;
  RotoscopeState state;
};

PaintedFilm painted_film(const RotoscopeOptions& options) {
  PaintedFilm film;
  for (int i = 0; i < frames; ++i) film.frames.push_back(rotoscope_frame(film_frame(i).pictures, options, film.state));
  return film;
}

TEST(HalfSize, IsForStrokesThatAreWideEnough) {
  Style style;
  EXPECT_TRUE(may_be_planned_at_half_size(style, 1920));
  EXPECT_FALSE(may_be_planned_at_half_size(style, 640)) << "its finest brush would be a pixel wide";
  style.absolute_radii = true;
  EXPECT_FALSE(may_be_planned_at_half_size(style, 1920));
  EXPECT_FALSE(may_be_planned_at_half_size(style_by_name("posterise"), 1920));
}

TEST(HalfSize, RangesHoldWhatTheyHeld) {
  const DisparityRange half = at_half_size(DisparityRange{-7, 9});
  EXPECT_EQ(half.least, -4);
  EXPECT_EQ(half.largest, 5);
}

TEST(HalfSize, PaintsAsAtTheWholeSizeForBothEyes) {
  const PaintedFilm whole = painted_film(options_of(false)), half = painted_film(options_of(true));
  EXPECT_EQ(half.state.central_before.width(), 96) << "it was not planned at half the size";
  for (int i = 0; i < frames; ++i) {
    const SyntheticFilmFrame film = film_frame(i);
    const StereoPair &a = std::get<StereoPair>(whole.frames[i].pictures),
                     &b = std::get<StereoPair>(half.frames[i].pictures);
    ASSERT_TRUE(same_size(b.left, film.pictures.left) && same_size(b.right, film.pictures.right));
    EXPECT_GT(psnr_db(b.left, film.pictures.left), psnr_db(a.left, film.pictures.left) - 1) << i;
    EXPECT_GT(psnr_db(b.right, film.pictures.right), psnr_db(a.right, film.pictures.right) - 1) << i;
    const auto left_right = [&](const StereoPair& pictures) {
      return measure_left_right_difference(pictures, film.geometry.left_disparity).mean_absolute;
    };
    EXPECT_LT(left_right(b), left_right(a) * 1.3 + 0.2) << i;
  }
  const RotoscopeTotals& totals = half.state.totals;
  EXPECT_EQ(totals.popped_strokes, 0);
  EXPECT_GT(static_cast<double>(totals.survived_strokes), 0.8 * static_cast<double>(totals.whole_strokes));
}

TEST(HalfSize, GoesOnFromItsStateWithTheSameBytes) {
  const TemporaryFolder folder;
  RotoscopeState kept;
  for (int i = 0; i < 2; ++i) rotoscope_frame(film_frame(i).pictures, options_of(true), kept);
  write_rotoscope_state(folder / "state", kept);
  RotoscopeState read = read_rotoscope_state(folder / "state");
  const StereoPair next = film_frame(2).pictures;
  const RotoscopedFrame a = rotoscope_frame(next, options_of(true), kept),
                        b = rotoscope_frame(next, options_of(true), read);
  EXPECT_EQ(std::get<StereoPair>(a.pictures).left, std::get<StereoPair>(b.pictures).left);
  EXPECT_EQ(std::get<StereoPair>(a.pictures).right, std::get<StereoPair>(b.pictures).right);
  EXPECT_EQ(a.painting, b.painting);
  EXPECT_GT(a.changes.survived, 0);
}

TEST(HalfSize, DepthOfTheScreenIsInTheFilmsPixels) {
  RotoscopeOptions options = options_of(true);
  options.depth_budget = 0.02f;
  RotoscopeState half, whole;
  const RotoscopedFrame painted = rotoscope_frame(film_frame(0).pictures, options, half);
  options.at_half_size = false;
  const RotoscopedFrame expected = rotoscope_frame(film_frame(0).pictures, options, whole);
  ASSERT_TRUE(are_moved(expected.eyes));
  EXPECT_NEAR(painted.eyes.separation, expected.eyes.separation, 0.05);
  EXPECT_NEAR(painted.eyes.zero_parallax_px, expected.eyes.zero_parallax_px, 1.5);
}

}  // namespace wheatstone::half_size_test
