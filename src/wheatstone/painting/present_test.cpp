// Pictures of a painting, and views in one picture: as if the views were drawn first.

#include "wheatstone/painting/present.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "needs_gpu.h"
#include "psnr.h"
#include "scenes/two_surfaces.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/two_eyes.h"

namespace wheatstone::present_test {

class PresentGpu : public NeedsGpu {
 protected:
  static std::vector<ViewPosition> positions(int count) {
    std::vector<ViewPosition> views;
    for (int v = 0; v < count; ++v) views.emplace_back(2 * static_cast<float>(v) / static_cast<float>(count - 1) - 1);
    return views;
  }

  static std::vector<Image<Rgb8>> drawn(const Painting& painting, const std::vector<ViewPosition>& views) {
    return present(painting, {.views = views, .device = Device::graphics}).views;
  }
};

Painting painting_of(const char* style) {
  return paint(test_scene::photographs(), test_scene::geometry(), style_by_name(style)).painting;
}

TEST_F(PresentGpu, DrawsUnderLensesOnlyWhatTheScreenShows) {
  const LenticularScreen screen{
      .width = test_scene::width / 2, .height = test_scene::height / 2, .pitch = 60, .slope = -4.3};
  const std::vector<ViewPosition> views = positions(4);
  const Painting painting = painting_of("impressionist");
  const Presentation by_processor{.views = views, .composition = screen};
  Presentation by_gpu = by_processor;
  by_gpu.device = Device::graphics;
  const Image<Rgb8> composed = present(painting, by_gpu).composed;
  EXPECT_EQ(composed, interleave(drawn(painting, views), screen));
  EXPECT_GT(psnr_db(composed, present(painting, by_processor).composed), 45);
}

TEST_F(PresentGpu, ComposesEveryKindOfMarksInEveryWay) {
  const std::vector<ViewPosition> views = positions(2);
  const std::array<DisplayComposition, 5> ways{QuiltLayout{2, 1}, LenticularScreen{.width = 211, .height = 97},
                                               anaglyph_kinds().front(), StereoLayout::checkerboard,
                                               StereoLayout::left_right_half};
  for (const char* const style : {"impressionist", "posterise", "diffusion"}) {
    SCOPED_TRACE(style);
    const Painting painting = painting_of(style);
    const std::vector<Image<Rgb8>> pictures = drawn(painting, views);
    for (const DisplayComposition& way : ways) {
      const Presentation presentation{.views = views, .composition = way, .device = Device::graphics};
      EXPECT_EQ(present(painting, presentation).composed, compose(pictures, way));
    }
  }
}

TEST(Present, ComposesWhatTheProcessorDraws) {
  const Painting painting = painting_of("impressionist");
  Presentation presentation = for_two_eyes();
  const Presented apart = present(painting, presentation);
  ASSERT_EQ(apart.views.size(), 2u);
  EXPECT_TRUE(apart.composed.empty());
  EXPECT_EQ(apart.worst_bare_share, std::max(apart.bare_shares[0], apart.bare_shares[1]));
  for (const DisplayComposition& way :
       {DisplayComposition(QuiltLayout{2, 1}), DisplayComposition(StereoLayout::even_odd_rows)}) {
    presentation.composition = way;
    const Presented composed = present(painting, presentation);
    EXPECT_EQ(composed.composed, compose(apart.views, way));
    EXPECT_TRUE(composed.views.empty());
    EXPECT_EQ(composed.worst_bare_share, apart.worst_bare_share);
  }
}

TEST(Present, DrawsEachViewAsItIsPlacedAndOverItsOwnBackground) {
  const Painting painting = painting_of("impressionist");
  const Placement placement{.width = 60, .height = 40, .scale = 0.5, .left = 10, .top = 4, .zero_parallax_px = 3};
  const Image<Rgb8> red(60, 40, {255, 0, 0});
  const PreparedPainting prepared = prepare(painting, {.placement = placement});
  const Presented shown =
      present(painting, {.views = {left_eye, central_view}, .placement = placement, .backgrounds = {red, {}}});
  const DrawnView over_red = draw(prepared, left_eye, red), alone = draw(prepared, central_view);
  EXPECT_EQ(shown.views[0], over_red.picture);
  EXPECT_EQ(shown.views[1], alone.picture);
  EXPECT_EQ(shown.bare_shares, (std::vector{over_red.bare_share, alone.bare_share}));
}

TEST(Present, ShowsNearerEyesWithTheOwnOnesInOneCall) {
  const Painting painting = painting_of("impressionist");
  EXPECT_EQ(for_own_and_nearer_eyes(1).views, for_two_eyes().views);
  const Presentation four = for_own_and_nearer_eyes(0.4f);
  EXPECT_EQ(four.views, (std::vector{left_eye, right_eye, ViewPosition(-0.2f), ViewPosition(0.2f)}));
  const std::vector<Image<Rgb8>> nearer = present(painting, for_two_eyes({.separation = 0.4f})).views;
  const std::vector<Image<Rgb8>> all = present(painting, four).views;
  EXPECT_EQ(all[0], draw(painting, left_eye).picture);
  EXPECT_EQ(all[2], nearer[0]);
  EXPECT_EQ(all[3], nearer[1]);
}

}  // namespace wheatstone::present_test
