#include "wheatstone/strokes/begun_canvas_internal.h"

#include <gtest/gtest.h>

#include <memory>

#include "wheatstone/random.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone::begun_canvas_test {

// Sizes that the smaller canvas does not divide evenly, and several bands.
constexpr int width = 61, height = 803, factor = 2;

Image<Rgb8> picture(int columns, int rows, std::uint64_t seed) {
  Image<Rgb8> made(columns, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::uint64_t random =
          hash_keys({seed, static_cast<std::uint64_t>(x / 5), static_cast<std::uint64_t>(y / 7)});
      made(x, y) = {static_cast<std::uint8_t>(random), static_cast<std::uint8_t>(random >> 8),
                    static_cast<std::uint8_t>(random >> 16)};
    }
  return made;
}

/// Painted in its upper part.
Canvas smaller_canvas() {
  Canvas canvas = make_canvas(picture(width / factor, height / factor, 1));
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < canvas.width; ++x)
      canvas.coverage(x, y) = unit_float(hash_keys({2, static_cast<std::uint64_t>(x + 100 * y)}));
  return canvas;
}

StrokesToDraw strokes() {
  StrokesToDraw made{{3, {}, {}}, central_view, {}, {}};
  for (std::uint32_t i = 0; i < 60; ++i) {
    const float y = 13.7f * static_cast<float>(i);
    for (const float x : {4.f, 30.f, 55.f}) made.layer.points.push_back({x, y + x / 9, 0});
    Stroke stroke{.first_point = 3 * i, .point_count = 3};
    stroke.radius_px = 3;
    stroke.colour = {static_cast<std::uint8_t>(4 * i), 90, 200};
    stroke.views = all_views;
    made.layer.strokes.push_back(stroke);
  }
  return made;
}

Canvas drawn_whole(const BegunCanvas& begun) {
  Canvas canvas = enlarged_canvas(begun);
  if (begun.strokes != nullptr) rasterise(begun.strokes->layer, begun.strokes->view, {}, canvas, begun.strokes->brush);
  return canvas;
}

TEST(BegunCanvas, LooksTheSameWhetherItIsEnlargedAtOnceOrInBands) {
  const Canvas smaller = smaller_canvas();
  const StrokesToDraw over = strokes();
  for (const StrokesToDraw* const drawn : {static_cast<const StrokesToDraw*>(nullptr), &over}) {
    const BegunCanvas begun(smaller, factor, width, height, drawn);
    const Canvas whole = drawn_whole(begun);
    EXPECT_EQ(picture_of(begun), picture_of(whole));
    EXPECT_EQ(bare_pixels(begun, {}), bare_pixels(whole, {}));
    EXPECT_EQ(painted_picture(begun), painted_picture(whole));
  }
  EXPECT_NE(picture_of(BegunCanvas(smaller, factor, width, height, &over)),
            picture_of(BegunCanvas(smaller, factor, width, height)));
}

/// The strokes of a traced layer on such a canvas.
Layer traced_on(const BegunCanvas& begun) {
  const Style style;
  const Image<Rgb8> photograph = picture(width, height, 5);
  const Image<float> disparity(width, height, 3.f);
  const View view{photograph, disparity, {}, left_eye};
  const LayerPlan plan{.style = style,
                       .view = view,
                       .canvas = begun,
                       .reference = std::make_shared<const ReferencePicture>(make_reference(photograph, 4, style))};
  return plan_layer(plan);
}

TEST(BegunCanvas, StrokesThatAreTracedOnItAreTheSame) {
  const Canvas smaller = smaller_canvas();
  const BegunCanvas begun(smaller, factor, width, height);
  const Layer in_bands = traced_on(begun), at_once = traced_on(enlarged_canvas(begun));
  EXPECT_GT(at_once.strokes.size(), 100u);
  EXPECT_EQ(in_bands.points, at_once.points);
  EXPECT_EQ(in_bands.strokes, at_once.strokes);
}

}  // namespace wheatstone::begun_canvas_test
