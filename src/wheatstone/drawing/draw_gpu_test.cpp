// Paintings by the graphics processor against those by the processor.

#include <gtest/gtest.h>

#include <vector>

#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/two_surfaces.h"
#include "throws_error.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone {
namespace {

/// One beyond the eyes, one between them, and an eye.
const std::vector<ViewPosition> wide{ViewPosition(-2.5), ViewPosition(-0.13), right_eye};

std::vector<Image<Rgb8>> pictures_of(const Painting& painting, Device device,
                                     std::span<const ImageView<const Rgb8>> backgrounds = {}) {
  std::vector<Image<Rgb8>> pictures;
  for (DrawnView& view : draw(prepare(painting, {}, device), wide, backgrounds))
    pictures.push_back(std::move(view.picture));
  return pictures;
}

Painting painting_of(const Style& style) {
  return paint(test_scene::photographs(), test_scene::geometry(), style).painting;
}

class DrawGpu : public NeedsGpu {};

TEST_F(DrawGpu, DrawsStrokesAsTheProcessorDoes) {
  for (const char* const name : {"impressionist", "pointillist"}) {
    const Painting painting = painting_of(style_by_name(name));
    EXPECT_GT(worst_psnr(pictures_of(painting, Device::graphics), pictures_of(painting, Device::processor)), 45)
        << name;
  }
}

TEST_F(DrawGpu, DrawsRegionsAsTheProcessorDoes) {
  for (const char* const name : {"posterise", "mosaic"}) {
    const Painting painting = painting_of(style_by_name(name));
    EXPECT_GT(worst_psnr(pictures_of(painting, Device::graphics), pictures_of(painting, Device::processor)), 45)
        << name;
  }
}

TEST_F(DrawGpu, DrawsLinesOfColourAsTheProcessorDoes) {
  const Painting painting = painting_of(style_by_name("diffusion"));
  EXPECT_GT(worst_psnr(pictures_of(painting, Device::graphics), pictures_of(painting, Device::processor)), 45);
}

TEST_F(DrawGpu, LaysStrokesOverABackground) {
  const Painting painting = painting_of(style_by_name("impressionist"));
  StrokePainting thin = std::get<StrokePainting>(painting.marks);
  thin.layers.resize(1);
  for (Stroke& stroke : thin.layers[0].strokes) stroke.opacity = 0.5f;
  const Image<Rgb8> background = test_scene::photographs().left;
  const std::vector<ImageView<const Rgb8>> backgrounds(wide.size(), background);
  EXPECT_GT(worst_psnr(pictures_of({.marks = thin}, Device::graphics, backgrounds),
                       pictures_of({.marks = thin}, Device::processor, backgrounds)),
            45);
}

TEST_F(DrawGpu, MarksWhatIsBareAsTheProcessorDoes) {
  Painting painting = painting_of(style_by_name("impressionist"));
  std::get<StrokePainting>(painting.marks).layers.resize(1);
  const DrawnView expected = draw(prepare(painting), right_eye);
  const DrawnView found = draw(prepare(painting, {}, Device::graphics), right_eye);
  EXPECT_GT(expected.bare_share, 0.001);
  EXPECT_NEAR(found.bare_share, expected.bare_share, 0.0005);
}

TEST_F(DrawGpu, GivesTheSameBytesEveryTime) {
  for (const char* const name : {"impressionist", "diffusion"}) {
    const Painting painting = painting_of(style_by_name(name));
    EXPECT_EQ(pictures_of(painting, Device::graphics), pictures_of(painting, Device::graphics)) << name;
  }
}

TEST_F(DrawGpu, DrawsAPaintingThatHasNoMarks) {
  const Painting empty{.marks = StrokePainting{40, 30, {200, 100, 50}, {}, true}};
  EXPECT_EQ(pictures_of(empty, Device::graphics), pictures_of(empty, Device::processor));
}

TEST_F(DrawGpu, DrawsViewsFartherOutThanTheFirstOnes) {
  const Painting painting = painting_of(style_by_name("impressionist"));
  const PreparedPainting kept = prepare(painting, {}, Device::graphics);
  draw(kept, central_view);
  EXPECT_GT(psnr_db(draw(kept, ViewPosition(2.5)).picture, draw(prepare(painting), ViewPosition(2.5)).picture), 45);
}

TEST_F(DrawGpu, RefusesRelief) {
  Painting painting = painting_of(style_by_name("impressionist"));
  painting.relief.depth_px = 1;
  expect_error(ErrorKind::wrong_usage, "--device cpu", [&] { prepare(painting, {}, Device::graphics); });
}

}  // namespace
}  // namespace wheatstone
