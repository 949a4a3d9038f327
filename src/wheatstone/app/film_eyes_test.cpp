// The depth budget of films.

#include "wheatstone/app/film_presentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/moving_picture.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::film_eyes_test {

constexpr PictureSize frame_size{200, 100};

/// Where a disparity of the film lies on the screen, in widths of the frame, positive before it.
float before_screen(const TwoEyes& eyes, float disparity_px) {
  return eyes.separation * static_cast<float>(eyes.placement.scale) * (disparity_px - eyes.zero_parallax_px) /
         static_cast<float>(frame_size.width);
}

TEST(FilmEyes, NearAndFarFitTheBudgetBeforeAndBehindTheScreen) {
  for (const float budget : {0.01f, 0.03f, 0.1f})
    for (const DepthEnds ends : {DepthEnds{-40, 30}, {0, 60}, {-90, -70}, {25, 26}, {3, 3}, {-2, 120}}) {
      const TwoEyes eyes = comfortable_eyes(frame_size, ends, budget);
      EXPECT_LE(before_screen(eyes, ends.nearest_px), budget / 3 * 1.02f) << ends.nearest_px;
      EXPECT_GE(before_screen(eyes, ends.farthest_px), -budget * 2 / 3 * 1.02f) << ends.farthest_px;
      EXPECT_LE(eyes.separation, 1);
      EXPECT_GT(eyes.separation, 0);
    }
}

TEST(FilmEyes, AFilmThatFitsKeepsItsEyesAndItsScreenPlane) {
  EXPECT_FALSE(are_moved(comfortable_eyes(frame_size, {-3.9f, 1.9f}, 0.03f)));
  // Too deep on both sides of its screen: the plane stays where it is.
  const TwoEyes nearer = comfortable_eyes(frame_size, {-8, 4}, 0.03f);
  EXPECT_NEAR(nearer.separation, 0.5f, 1e-3);
  EXPECT_NEAR(nearer.zero_parallax_px, 0, 1e-3);
}

SyntheticFilmOptions film_options(int cut) {
  SyntheticFilmOptions options;
  options.still.width = 160;
  options.still.height = 96;
  options.still.samples_a_side = 1;
  options.frames = 12;
  options.cut = cut;
  return options;
}

KnownFrame known_frame(int frame, int cut) {
  return {make_synthetic_film_frame(film_options(cut), frame).geometry, {}};
}

struct LookedAt {
  std::vector<TwoEyes> eyes;
  std::vector<StereoPair> pictures;
  RotoscopeTotals totals;
};

LookedAt presented(std::optional<float> budget, int frames, int cut = 0) {
  RotoscopeOptions options;
  options.depth_budget = budget;
  RotoscopeState state;
  LookedAt film;
  for (int i = 0; i < frames; ++i) {
    const KnownFrame known = known_frame(i, cut);
    RotoscopedFrame frame =
        rotoscope_frame(make_synthetic_film_frame(film_options(cut), i).pictures, options, state, &known);
    film.eyes.push_back(frame.eyes);
    film.pictures.push_back(std::get<StereoPair>(std::move(frame.pictures)));
  }
  film.totals = state.totals;
  return film;
}

TEST(FilmEyes, WhatIsLookedAtHasNoMoreDepthThanTheBudget) {
  const auto depth_of = [](const StereoPair& pair) {
    const DepthEnds ends = depth_ends(match(pair, {}).geometry.left_disparity);
    return ends.nearest_px - ends.farthest_px;
  };
  const LookedAt comfortable = presented(comfortable_parallax_share, 1), full = presented({}, 1);
  const double budget_px = 160.0 * static_cast<double>(comfortable_parallax_share);
  const double whole = depth_of(full.pictures[0]), shown = depth_of(comfortable.pictures[0]);
  RecordProperty("full_px", std::to_string(whole));
  RecordProperty("shown_px", std::to_string(shown));
  EXPECT_GT(whole, 1.5 * budget_px) << "the film must be too deep to begin with";
  EXPECT_LE(shown, budget_px + 1.5) << "found to a pixel";
  EXPECT_EQ(full.totals.moved_frames, 0);
  EXPECT_EQ(full.totals.least_separation, 1);
  EXPECT_EQ(comfortable.totals.moved_frames, 1);
  EXPECT_LT(comfortable.totals.least_separation, 0.7);
}

TEST(FilmEyes, AreSteadyFromCutToCut) {
  const LookedAt film = presented(comfortable_parallax_share, 8, 4);
  for (std::size_t i = 1; i < film.eyes.size(); ++i) {
    if (i == 4) continue;
    EXPECT_LE(film.eyes[i].separation, film.eyes[i - 1].separation) << i << ": they do not part again";
    EXPECT_NEAR(film.eyes[i].separation, film.eyes[i - 1].separation, 0.01) << i;
    EXPECT_NEAR(film.eyes[i].zero_parallax_px, film.eyes[i - 1].zero_parallax_px, 0.5) << i;
  }
}

TEST(FilmEyes, AFilmTellsThatItsEyesWereMovedAndAFullOneSaysNothing) {
  const TemporaryFolder folder;
  FilmWriter writer(folder / "a.mkv", {.codec = "ffv1", .layout = StereoLayout::left_right});
  for (int i = 0; i < 3; ++i) {
    const StereoPair eyes = make_synthetic_film_frame(film_options(0), i).pictures;
    writer.write({put_together(eyes.left, eyes.right, StereoLayout::left_right), i, {1, 25}, 1});
  }
  writer.finish();
  for (const char* name : {"o.mp4", "o.mkv", "o.mov"}) {
    RotoscopeFilmOptions options;
    options.frames.depth_budget = comfortable_parallax_share;
    options.writing.preset = "ultrafast";
    options.writing.layout = StereoLayout::left_right;
    StereoFilmReader source = open_stereo_film(folder / "a.mkv");
    rotoscope_film(source, folder / name, options);
    const std::string comment = open_film(folder / name).facts().comment;
    EXPECT_TRUE(tells_moved_eyes(comment)) << name << ": " << comment;
    EXPECT_NE(comment.find("in 3 frames"), std::string::npos) << comment;
  }
  RotoscopeFilmOptions options;
  options.writing.preset = "ultrafast";
  StereoFilmReader source = open_stereo_film(folder / "a.mkv");
  rotoscope_film(source, folder / "full.mp4", options);
  EXPECT_EQ(open_film(folder / "full.mp4").facts().comment, "");
}

}  // namespace wheatstone::film_eyes_test
