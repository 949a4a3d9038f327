// Diffusion curves in a film: how still they stand on what they are the edges of, and what a scene's beginning forgets.

#include "wheatstone/curves/diffusion_in_time.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <optional>

#include "throws_error.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::diffusion_in_time_test {

constexpr int width = 320, height = 180, frames = 6;

/// One frame with all that planning takes.
struct Shot {
  SyntheticFilmFrame frame;
  CentralView centre;
  std::optional<FlowPair> flow;  ///< of the central view, from the frame before

  std::vector<View> views() const { return scene_from_centre(centre, frame.pictures, frame.geometry); }
};

std::vector<Shot> film_of(FilmMotion motion, float noise) {
  SyntheticFilmOptions options{.frames = frames, .cut = 0, .motion = motion, .noise = noise};
  options.still.width = width;
  options.still.height = height;
  options.still.samples_a_side = 2;
  std::vector<Shot> film;
  for (int i = 0; i < frames; ++i) {
    Shot shot{make_synthetic_film_frame(options, i), {}, {}};
    shot.centre = make_central_view(shot.frame.pictures, shot.frame.geometry);
    if (i > 0) shot.flow = estimate_flow(film.back().centre.picture, shot.centre.picture);
    film.push_back(std::move(shot));
  }
  return film;
}

const std::vector<Shot>& walk() {
  static const std::vector<Shot> film = film_of(FilmMotion::walk, 10);
  return film;
}

Style style() { return style_by_name("diffusion"); }

Painting plan(const Shot& shot, PaintingMemory& memory) {
  const std::vector<View> views = shot.views();
  return plan_frame(FilmFrame{views, shot.flow ? &*shot.flow : nullptr}, style(), {}, memory).painting;
}

/// Each frame's painting; with one memory, or each with a fresh one.
std::vector<Painting> plan_film(const std::vector<Shot>& film, bool remember) {
  std::vector<Painting> paintings;
  PaintingMemory memory;
  for (const Shot& shot : film) {
    if (!remember) memory = {};
    paintings.push_back(plan(shot, memory));
  }
  return paintings;
}

/// The walk, painted with one memory.
const std::vector<Painting>& painted_walk() {
  static const std::vector<Painting> painted = plan_film(walk(), true);
  return painted;
}

std::vector<Image<Rgb8>> left_pictures(const std::vector<Painting>& paintings) {
  std::vector<Image<Rgb8>> pictures;
  for (const Painting& painting : paintings) pictures.push_back(draw(painting, left_eye).picture);
  return pictures;
}

double temporal_error(const std::vector<Shot>& film, const std::vector<Image<Rgb8>>& pictures) {
  TemporalError error;
  for (std::size_t i = 1; i < film.size(); ++i)
    error.add(pictures[i - 1], pictures[i],
              relate_frames(FlowPair{film[i - 1].frame.to_next, film[i].frame.to_previous}));
  EXPECT_GT(error.compared_share(), 0.8);
  return error.mean();
}

/// A film's frames for the left eye, with and without a memory.
struct Seen {
  std::vector<Image<Rgb8>> steady, fresh;
};

const Seen& seen_walk() {
  static const Seen seen{left_pictures(painted_walk()), left_pictures(plan_film(walk(), false))};
  return seen;
}

void expect_steadier(const std::vector<Shot>& film, const Seen& seen, double most) {
  const auto& [steady, fresh] = seen;
  const double with = temporal_error(film, steady), without = temporal_error(film, fresh);
  testing::Test::RecordProperty("with_memory", std::to_string(with));
  testing::Test::RecordProperty("without", std::to_string(without));
  EXPECT_LT(with, most * without);
  // Not by blurring.
  EXPECT_GT(gradient_energy(steady.back()), 0.9 * gradient_energy(fresh.back()));
}

TEST(DiffusionInTime, FlickersLessThanFramesOnTheirOwn) { expect_steadier(walk(), seen_walk(), 0.89); }

TEST(DiffusionInTime, FlickersLessWhereTheCameraTurnsSlowly) {
  const std::vector<Shot> pan = film_of(FilmMotion::pan, 10);
  expect_steadier(pan, {left_pictures(plan_film(pan, true)), left_pictures(plan_film(pan, false))}, 0.88);
}

TEST(DiffusionInTime, StaysTrueToEachFrame) {
  const auto difference = [](const Image<Rgb8>& a, const Image<Rgb8>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) sum += std::abs(a.pixels()[i].g - b.pixels()[i].g);
    return sum / static_cast<double>(a.pixels().size());
  };
  const auto& [steady, fresh] = seen_walk();
  const Image<Rgb8>& last = walk().back().frame.pictures.left;
  EXPECT_LT(difference(steady.back(), last), 1.05 * difference(fresh.back(), last));
  EXPECT_GT(difference(steady.front(), last), 1.3 * difference(steady.back(), last)) << "the film moves";
}

TEST(DiffusionInTime, FusesAsWellAsAStill) {
  const auto difference = [](const Shot& shot, const Painting& painting) {
    const StereoPair drawn{draw(painting, left_eye).picture, draw(painting, right_eye).picture};
    return measure_left_right_difference(drawn, shot.frame.geometry.left_disparity).mean_absolute;
  };
  const Shot& shot = walk().back();
  const double film = difference(shot, painted_walk().back());
  PaintingMemory nothing_before;
  const double afresh = difference(shot, plan(shot, nothing_before));
  const double still = difference(shot, plan_painting(shot.frame.pictures, shot.frame.geometry, style()));
  Style alone = style();
  alone.propagation = Propagation::independent;
  const double independent = difference(shot, plan_painting(shot.frame.pictures, shot.frame.geometry, alone));
  RecordProperty("film", std::to_string(film));
  RecordProperty("afresh", std::to_string(afresh));
  RecordProperty("still", std::to_string(still));
  RecordProperty("independent", std::to_string(independent));
  EXPECT_LT(film, 1.05 * afresh);
  // The still's left eye is its reference view, which is drawn without being moved.
  EXPECT_LT(film, 1.35 * still);
  EXPECT_LT(film, 0.5 * independent);
}

TEST(DiffusionInTime, ForgetsAllWhereASceneBegins) {
  PaintingMemory memory, fresh;
  for (int i = 0; i < 3; ++i) plan(walk()[static_cast<std::size_t>(i)], memory);
  Shot begun = walk()[3];
  const Painting remembered = [&] {
    PaintingMemory copy = memory;
    return plan(begun, copy);
  }();
  begun.flow.reset();
  const Painting again = plan(begun, memory);
  EXPECT_EQ(again, plan(begun, fresh));
  EXPECT_NE(again, remembered);
  const std::vector<View> views = begun.views();
  DiffusionMemory nothing_before;
  EXPECT_EQ(plan_diffusion(FilmFrame{views, nullptr}, style(), nothing_before), plan_diffusion(views, style()))
      << "the first frame is a still";
}

TEST(DiffusionInTime, GivesTheSameBytesOnAnyNumberOfThreads) {
  Painting first;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Painting last = plan_film(walk(), true).back();
    if (width_of(first) == 0) first = last;
    EXPECT_EQ(last, first);
  }
}

TEST(DiffusionInTime, PaintsASceneOfOneView) {
  const Image<float> flat(width, height, 0);
  PaintingMemory memory;
  for (const Shot& shot : walk()) {
    const std::vector<View> views{{shot.centre.picture, flat, {}, central_view}};
    const Painting painting =
        plan_frame(FilmFrame{views, shot.flow ? &*shot.flow : nullptr}, style(), {}, memory).painting;
    const DrawnView drawn = draw(painting, central_view);
    EXPECT_EQ(drawn.bare_share, 0);
    EXPECT_EQ(drawn.picture, draw(painting, left_eye).picture) << "it has no depth";
  }
}

TEST(DiffusionInTime, RefusesWhatDoesNotFit) {
  DiffusionMemory memory;
  expect_error(ErrorKind::bad_input, "no pixels", [&] { plan_diffusion(FilmFrame{}, style(), memory); });
  const Image<float> small(3, 2);
  const FlowPair flow{{small, small}, {small, small}};
  const std::vector<View> views = walk()[0].views();
  expect_error(ErrorKind::bad_input, "flow", [&] { plan_diffusion(FilmFrame{views, &flow}, style(), memory); });
  const std::vector<View> torn{{views[0].colour, small, {}, central_view}};
  expect_error(ErrorKind::bad_input, "disparity", [&] { plan_diffusion(FilmFrame{torn, nullptr}, style(), memory); });
}

}  // namespace wheatstone::diffusion_in_time_test
