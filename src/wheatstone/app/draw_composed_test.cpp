// Views of a painting in one picture: as if the views were drawn first.

#include "wheatstone/app/draw_composed.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/two_surfaces.h"
#include "wheatstone/display/compose_gpu.h"
#include "wheatstone/painting/paint.h"

namespace wheatstone {
namespace {

class DrawComposedGpu : public NeedsGpu {
 protected:
  static std::vector<ViewPosition> positions(int count) {
    std::vector<ViewPosition> views;
    for (int v = 0; v < count; ++v) views.emplace_back(2 * static_cast<float>(v) / static_cast<float>(count - 1) - 1);
    return views;
  }

  static std::vector<Image<Rgb8>> drawn(const PreparedPainting& painting, std::span<const ViewPosition> views) {
    std::vector<Image<Rgb8>> pictures;
    for (DrawnView& view : draw(painting, views)) pictures.push_back(std::move(view.picture));
    return pictures;
  }
};

Painting painting_of(const char* style) {
  return paint(test_scene::photographs(), test_scene::geometry(), style_by_name(style)).painting;
}

TEST_F(DrawComposedGpu, DrawsUnderLensesOnlyWhatTheScreenShows) {
  const LenticularScreen screen{
      .width = test_scene::width / 2, .height = test_scene::height / 2, .pitch = 60, .slope = -4.3};
  const std::vector<ViewPosition> views = positions(4);
  const Painting painting = painting_of("impressionist");
  const PreparedPainting kept = prepare(painting, {}, Device::graphics);
  const ComposedViews composed = draw_composed(kept, views, screen);
  EXPECT_EQ(composed.picture, interleave(drawn(kept, views), screen));
  EXPECT_GT(psnr_db(composed.picture, draw_composed(prepare(painting), views, screen).picture), 45);
}

TEST_F(DrawComposedGpu, ComposesEveryKindOfMarksInEveryWay) {
  const std::vector<ViewPosition> views = positions(2);
  const std::array<DisplayComposition, 5> ways{QuiltLayout{2, 1}, LenticularScreen{.width = 211, .height = 97},
                                               anaglyph_kinds().front(), StereoLayout::checkerboard,
                                               StereoLayout::left_right_half};
  for (const char* const style : {"impressionist", "posterise", "diffusion"}) {
    SCOPED_TRACE(style);
    const PreparedPainting kept = prepare(painting_of(style), {}, Device::graphics);
    const std::vector<Image<Rgb8>> pictures = drawn(kept, views);
    for (const DisplayComposition& way : ways)
      EXPECT_EQ(draw_composed(kept, views, way).picture, compose(pictures, way));
  }
}

TEST(DrawComposed, ComposesWhatTheProcessorDraws) {
  const PreparedPainting prepared = prepare(painting_of("impressionist"));
  const std::array views{left_eye, right_eye};
  std::vector<Image<Rgb8>> pictures;
  double bare_share = 0;
  for (DrawnView& view : draw(prepared, views)) {
    pictures.push_back(std::move(view.picture));
    bare_share = std::max(bare_share, view.bare_share);
  }
  const ComposedViews composed = draw_composed(prepared, views, QuiltLayout{2, 1});
  EXPECT_EQ(composed.picture, make_quilt(pictures, {2, 1}));
  EXPECT_EQ(composed.worst_bare_share, bare_share);
  EXPECT_EQ(draw_composed(prepared, views, StereoLayout::even_odd_rows).picture,
            compose(pictures, StereoLayout::even_odd_rows));
}

}  // namespace
}  // namespace wheatstone
