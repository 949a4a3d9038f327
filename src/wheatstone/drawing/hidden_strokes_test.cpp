#include "wheatstone/drawing/hidden_strokes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "wheatstone/drawing/draw.h"

namespace wheatstone {
namespace {

constexpr int width = 40, height = 20;
constexpr Rgb8 red{200, 0, 0}, blue{0, 0, 200};

void add_dot(float x, float disparity, float radius_px, Rgb8 colour, Layer& layer) {
  layer.strokes.push_back({.first_point = static_cast<std::uint32_t>(layer.points.size()),
                           .point_count = 1,
                           .radius_px = radius_px,
                           .colour = colour,
                           .disparity = disparity,
                           .views = all_views});
  layer.points.push_back({x, height / 2.f, disparity});
}

TEST(HiddenStrokes, AreThoseThatNoViewShowsOfTheirLayer) {
  StrokePainting painting{.width = width, .height = height, .layers = {{}, {}}};
  Layer& coarse = painting.layers[0];
  Layer& fine = painting.layers[1];
  add_dot(10, 0, 3, red, coarse);  // hidden by the finer layer alone: stays
  add_dot(30, 0, 2, red, coarse);  // wholly behind the next
  add_dot(30, 0, 5, blue, coarse);
  add_dot(10, 0, 6, blue, fine);
  add_dot(20, 0, 2, red, fine);  // only some views look past the next
  add_dot(20, 8, 4, blue, fine);
  const std::array views{left_eye, right_eye};
  const StrokePainting kept = without_hidden_strokes(painting, {}, views, 1.f / 128);
  ASSERT_EQ(kept.layers[0].strokes.size(), 2u);
  EXPECT_EQ(kept.layers[0].strokes[0].colour, red);
  EXPECT_EQ(kept.layers[0].strokes[1].colour, blue);
  EXPECT_EQ(kept.layers[1].strokes.size(), 3u);
  EXPECT_EQ(without_hidden_strokes(painting, {}, std::array{left_eye}, 1.f / 128).layers[1].strokes.size(), 2u);
  for (const ViewPosition view : views)
    EXPECT_EQ(draw(Painting{kept}, view).picture, draw(Painting{painting}, view).picture);
}

}  // namespace
}  // namespace wheatstone
