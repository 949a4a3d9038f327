// Paintings by the graphics processor against those by the processor.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/two_surfaces.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/draw_gpu.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone::draw_gpu_test {

/// One beyond the eyes, one between them, and an eye.
const std::vector<ViewPosition> wide{ViewPosition(-2.5), ViewPosition(-0.13), right_eye};

std::vector<Image<Rgb8>> pictures_of(const Painting& painting, Device device,
                                     std::span<const ImageView<const Rgb8>> backgrounds = {},
                                     std::span<const ViewPosition> views = wide) {
  std::vector<Image<Rgb8>> pictures;
  for (DrawnView& view : draw(prepare(painting, {}, device), views, backgrounds))
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

TEST_F(DrawGpu, DrawsColoursThatChangeAlongStrokesAsTheProcessorDoes) {
  Painting painting = painting_of(style_by_name("oil"));
  auto& strokes = std::get<StrokePainting>(painting.marks);
  strokes.brush = {};
  const std::vector<Image<Rgb8>> expected = pictures_of(painting, Device::processor);
  EXPECT_GT(worst_psnr(pictures_of(painting, Device::graphics), expected), 45);
  for (Layer& layer : strokes.layers)
    for (Stroke& stroke : layer.strokes) stroke.change = {};
  EXPECT_LT(worst_psnr(pictures_of(painting, Device::processor), expected), 42);
}

TEST_F(DrawGpu, DrawsBristlesAsTheProcessorDoes) {
  // Between two columns the processor interpolates what they leave: here these views see all rows moved by whole
  // pixels.
  const std::vector<ViewPosition> views{ViewPosition(-2.5), ViewPosition(0.25), right_eye};
  const auto pictures = [&](const Painting& painting, Device device) {
    return pictures_of(painting, device, {}, views);
  };
  Painting painting = painting_of(style_by_name("oil"));
  auto& strokes = std::get<StrokePainting>(painting.marks);
  const Brush of_style = strokes.brush, coarse{.bristle_px = 3, .streaks = 40, .ridge = 0, .dry = 1},
              of_picture{.streaks = 40, .dry = 0.2f, .picture = built_in_brush("fan")};
  strokes.brush = {};
  const std::vector<Image<Rgb8>> even = pictures(painting, Device::processor);
  for (const Brush& brush : {of_style, coarse, of_picture}) {
    strokes.brush = brush;
    const std::vector<Image<Rgb8>> expected = pictures(painting, Device::processor);
    EXPECT_LT(worst_psnr(even, expected), 40) << brush.streaks;
    EXPECT_GT(worst_psnr(pictures(painting, Device::graphics), expected), 45) << brush.streaks;
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

/// A few pixels of each view, in tiles of which none, some or all are wanted; a bit each, rows of whole words.
constexpr std::size_t words_a_row = (test_scene::width + 31) / 32;

std::vector<std::uint32_t> some_wanted() {
  std::vector<std::uint32_t> bits(wide.size() * test_scene::height * words_a_row);
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = i % 7 == 0 ? ~0u : i % 3 == 0 ? 0 : 0x80010204u << i % 5;
  return bits;
}

/// The pixels of all views, as the graphics processor leaves them in its memory.
std::vector<std::uint32_t> pixels_left(const Painting& painting, bool only_some) {
  std::vector<std::uint32_t> pixels(wide.size() * test_scene::width * test_scene::height);
  const auto make_sink = [&](const GpuFacts&) {
    GpuViewSink sink{.take = [&](const GpuBuffer& drawn, std::size_t, std::size_t) { drawn.read(std::span(pixels)); }};
    if (only_some)
      sink.wanted = [](std::size_t, std::size_t) {
        const std::vector<std::uint32_t> bits = some_wanted();
        return GpuBuffer(std::span<const std::uint32_t>(bits));
      };
    return sink;
  };
  EXPECT_TRUE(draw_on_gpu(prepare(painting, {}, Device::graphics), wide, make_sink));
  for (std::uint32_t& pixel : pixels) pixel &= 0xffffff;
  return pixels;
}

TEST_F(DrawGpu, DrawsOnlyPixelsThatAreWanted) {
  const Painting painting = painting_of(style_by_name("impressionist"));
  const std::vector<std::uint32_t> all = pixels_left(painting, false), some = pixels_left(painting, true);
  const std::vector<std::uint32_t> bits = some_wanted();
  std::size_t place = 0, drawn = 0;
  for (std::size_t row = 0; row < wide.size() * test_scene::height; ++row)
    for (std::size_t x = 0; x < test_scene::width; ++x, ++place) {
      const bool is_wanted = (bits[row * words_a_row + x / 32] >> x % 32 & 1) != 0;
      ASSERT_TRUE(some[place] == all[place] || (!is_wanted && some[place] == 0)) << "row " << row << ", column " << x;
      drawn += some[place] != 0 ? 1 : 0;
    }
  EXPECT_LT(drawn, some.size() / 2);
}

TEST_F(DrawGpu, FillsGapsThatAreWanted) {
  Painting painting = painting_of(style_by_name("impressionist"));
  std::get<StrokePainting>(painting.marks).layers.resize(1);
  const std::vector<std::uint32_t> all = pixels_left(painting, false), some = pixels_left(painting, true);
  const std::vector<std::uint32_t> bits = some_wanted();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t row = i / test_scene::width, x = i % test_scene::width;
    const bool is_wanted = (bits[row * words_a_row + x / 32] >> x % 32 & 1) != 0;
    ASSERT_TRUE(!is_wanted || some[i] == all[i]) << "row " << row << ", column " << x;
  }
}

TEST_F(DrawGpu, LightsReliefAsTheProcessorDoes) {
  Painting painting = painting_of(style_by_name("impressionist"));
  const std::vector<Image<Rgb8>> flat = pictures_of(painting, Device::processor);
  painting.relief.depth_px = 1;
  const std::vector<Image<Rgb8>> expected = pictures_of(painting, Device::processor);
  EXPECT_LT(worst_psnr(flat, expected), 40);
  EXPECT_GT(worst_psnr(pictures_of(painting, Device::graphics), expected), 45);
}

}  // namespace wheatstone::draw_gpu_test
