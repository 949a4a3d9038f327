#include "wheatstone/motion/find_dissolve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::find_dissolve_test {

using Frames = std::vector<Image<Rgb8>>;

/// So many frames of a scene, from one on.
Frames film_of(FilmScene scene, std::uint64_t seed, int count, FilmMotion motion = FilmMotion::walk, float noise = 0) {
  SyntheticFilmOptions options{.still = {.width = 96, .height = 54, .seed = seed, .samples_a_side = 1},
                               .frames = count,
                               .cut = 0,
                               .scene = scene,
                               .motion = motion,
                               .noise = noise};
  Frames frames;
  for (int i = 0; i < count; ++i) frames.push_back(make_synthetic_film_frame(options, i).pictures.left);
  return frames;
}

Image<Rgb8> mixed(const Image<Rgb8>& a, const Image<Rgb8>& b, double share) {
  Image<Rgb8> both(a.width(), a.height());
  std::ranges::transform(a.pixels(), b.pixels(), both.pixels().begin(), [&](Rgb8 from, Rgb8 to) {
    const auto level = [&](std::uint8_t x, std::uint8_t y) {
      return static_cast<std::uint8_t>(std::lround(x + share * (y - x)));
    };
    return Rgb8{level(from.r, to.r), level(from.g, to.g), level(from.b, to.b)};
  });
  return both;
}

/// `mixtures` frames of both lie between what each has alone; both go on meanwhile.
Frames dissolved(const Frames& a, const Frames& b, int mixtures) {
  Frames frames;
  const auto alone = a.size() - static_cast<std::size_t>(mixtures);
  for (std::size_t i = 0; i < a.size(); ++i)
    frames.push_back(i < alone ? a[i] : mixed(a[i], b[i - alone], static_cast<double>(i - alone + 1) / (mixtures + 1)));
  frames.insert(frames.end(), b.begin() + mixtures, b.end());
  return frames;
}

/// Another scene: upside down, and its colours exchanged.
Frames turned(Frames frames) {
  for (Image<Rgb8>& frame : frames) {
    std::ranges::reverse(frame.pixels());
    for (Rgb8& pixel : frame.pixels()) pixel = {pixel.b, pixel.r, pixel.g};
  }
  return frames;
}

std::vector<FoundDissolve> dissolves_in(const Frames& frames) {
  DissolveFinder finder;
  for (const Image<Rgb8>& frame : frames) finder.add(frame);
  return finder.end_scene();
}

/// A walk along a table.
const Frames& walk() {
  static const Frames frames = film_of(FilmScene::still_life, 1, 60);
  return frames;
}

Frames first_of(const Frames& frames, int count) { return {frames.begin(), frames.begin() + count}; }

TEST(FindDissolve, FindsWhereScenesFadeIntoEachOther) {
  for (const int mixtures : {8, 24}) {
    const Frames one = first_of(walk(), 30 + mixtures);
    const std::vector<FoundDissolve> found = dissolves_in(dissolved(one, turned(one), mixtures));
    ASSERT_EQ(found.size(), 1u) << mixtures;
    EXPECT_NEAR(static_cast<double>(found[0].last_before), 29, 2 + mixtures / 12.) << mixtures;
    EXPECT_NEAR(static_cast<double>(found[0].first_after), 30 + mixtures, 2 + mixtures / 12.) << mixtures;
  }
  const Frames still(100, walk().front());
  EXPECT_EQ(dissolves_in(dissolved(still, turned(still), 70)), (std::vector<FoundDissolve>{{29, 100}}));
}

TEST(FindDissolve, FindsSeveralAndCountsFramesOfTheFilm) {
  const Frames one = first_of(walk(), 36), other = turned(walk());
  DissolveFinder finder;
  for (const Image<Rgb8>& frame : first_of(walk(), 12)) finder.add(frame);
  EXPECT_TRUE(finder.end_scene().empty());
  for (const Image<Rgb8>& frame : dissolved(dissolved(one, other, 12), one, 16)) finder.add(frame);
  const std::vector<FoundDissolve> found = finder.end_scene();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(static_cast<double>(found[0].first_after), 12 + 36, 3);
  EXPECT_NEAR(static_cast<double>(found[1].first_after), 12 + 84, 3);
}

TEST(FindDissolve, WhatMovesAndChangesItsLightIsNone) {
  EXPECT_TRUE(dissolves_in(walk()).empty());
  for (const FilmScene scene : {FilmScene::crowd, FilmScene::beams})
    EXPECT_TRUE(dissolves_in(film_of(scene, 1, 14)).empty()) << static_cast<int>(scene);
  EXPECT_TRUE(dissolves_in(film_of(FilmScene::still_life, 2, 24, FilmMotion::pan, 6)).empty());
  const Image<Rgb8> black(96, 54);
  Frames fade, lamp, cut = walk();
  for (std::size_t i = 0; i < walk().size(); ++i) {
    fade.push_back(mixed(walk()[i], black, std::clamp((static_cast<double>(i) - 10) / 30, 0., 1.)));
    lamp.push_back(mixed(walk()[i], black, 0.6 * std::clamp((static_cast<double>(i) - 20) / 20, 0., 1.)));
  }
  EXPECT_TRUE(dissolves_in(fade).empty());
  EXPECT_TRUE(dissolves_in(lamp).empty());
  const Frames other = turned(first_of(walk(), 40));
  cut.insert(cut.end(), other.begin(), other.end());
  EXPECT_TRUE(dissolves_in(cut).empty());
  EXPECT_TRUE(dissolves_in(first_of(walk(), 3)).empty());
  EXPECT_TRUE(dissolves_in({}).empty());
}

}  // namespace wheatstone::find_dissolve_test
