// Pictures of a painting of which little has changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "scenes/still_life.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::draw_again_test {

constexpr std::array views{left_eye, central_view, right_eye};

Painting planned(const char* style) {
  const SyntheticStill& still = still_life(240, 180);
  return plan_painting(still.pictures, still.geometry, style_by_name(style));
}

const Painting& oil() {
  static const Painting painting = planned("oil");
  return painting;
}

std::vector<Image<Rgb8>> pictures_of(const Painting& painting) {
  std::vector<Image<Rgb8>> pictures;
  for (DrawnView& view : draw(prepare(painting), views)) pictures.push_back(std::move(view.picture));
  return pictures;
}

/// As they are drawn again from those of `before`.
std::vector<Image<Rgb8>> drawn_again(const Painting& painting, const Painting& before) {
  std::vector<Image<Rgb8>> pictures = pictures_of(before);
  draw_again(prepare(painting), prepare(before), views, pictures);
  return pictures;
}

/// A painting that looks otherwise than before.
void expect_same(const Painting& painting) {
  const std::vector<Image<Rgb8>> pictures = pictures_of(painting);
  EXPECT_NE(pictures, pictures_of(oil()));
  EXPECT_EQ(drawn_again(painting, oil()), pictures);
}

/// Of the finest layer, about the middle of the picture.
Stroke& middle_stroke(Painting& painting) {
  Layer& layer = std::get<StrokePainting>(painting.marks).layers.back();
  return *std::ranges::find_if(layer.strokes, [&](const Stroke& stroke) {
    const ControlPoint& first = layer.points_of(stroke).front();
    return first.y > 80 && first.y < 90 && first.x > 60;
  });
}

TEST(DrawAgain, GivesTheBytesOfDrawingWhateverHasChanged) {
  Painting recoloured = oil();
  middle_stroke(recoloured).colour = {255, 0, 0};
  expect_same(recoloured);

  Painting erased = oil();
  Layer& finest = std::get<StrokePainting>(erased.marks).layers.back();
  number_by_place(finest);
  finest.strokes.erase(finest.strokes.begin() + 10, finest.strokes.begin() + 20);
  expect_same(erased);
  EXPECT_EQ(drawn_again(oil(), erased), pictures_of(oil()));

  Painting nearer = oil();
  for (ControlPoint& point : std::get<StrokePainting>(nearer.marks).layers.front().points)
    if (point.y > 100) point.disparity += 2;
  expect_same(nearer);

  Painting hidden = oil();
  KnownRuns& surface = hidden.surfaces.seen.front().disparity;
  std::ranges::fill(surface.values_of(surface.runs_of(90).front()), 100.f);
  expect_same(hidden);

  Painting bare = oil();
  std::get<StrokePainting>(bare.marks).canvas_shows = true;
  for (Layer& layer : std::get<StrokePainting>(bare.marks).layers) layer.strokes.clear();
  Painting on_black = bare;
  std::get<StrokePainting>(on_black.marks).canvas_colour = {0, 0, 0};
  EXPECT_NE(pictures_of(on_black), pictures_of(bare));
  EXPECT_EQ(drawn_again(on_black, bare), pictures_of(on_black));
}

TEST(DrawAgain, GivesTheBytesOfDrawingWhereASurfaceHasFewRows) {
  Painting few_rows = oil();
  few_rows.surfaces.seen = {{left_eye, KnownRuns(240, 1)}};
  few_rows.surfaces.seen.front().disparity.add_row(std::vector<float>(240, 0.f));
  Painting recoloured = few_rows;
  middle_stroke(recoloured).colour = {255, 0, 0};
  EXPECT_EQ(drawn_again(recoloured, few_rows), pictures_of(recoloured));
}

TEST(DrawAgain, GivesTheBytesOfDrawingAnyOtherPainting) {
  for (const char* other : {"impressionist", "diffusion"}) {
    SCOPED_TRACE(other);
    const Painting painting = planned(other);
    EXPECT_EQ(drawn_again(painting, oil()), pictures_of(painting));
    EXPECT_EQ(drawn_again(oil(), painting), pictures_of(oil()));
  }
}

TEST(DrawAgain, DrawsOnlyBandsInWhichSomethingDiffers) {
  Painting recoloured = oil();
  middle_stroke(recoloured).colour = {255, 0, 0};
  std::vector<Image<Rgb8>> pictures(views.size(), Image<Rgb8>(240, 180, {1, 2, 3}));
  draw_again(prepare(recoloured), prepare(oil()), views, pictures);
  EXPECT_EQ(pictures.front()(120, 10), (Rgb8{1, 2, 3}));
  EXPECT_EQ(pictures.front()(120, 170), (Rgb8{1, 2, 3}));
  EXPECT_EQ(pictures.front()(120, 85), pictures_of(recoloured).front()(120, 85));
}

}  // namespace wheatstone::draw_again_test
