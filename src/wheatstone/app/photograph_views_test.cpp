// Views of a photograph that is not painted.

#include "wheatstone/app/display_views.h"

#include <gtest/gtest.h>

#include "psnr.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::photograph_views_test {

constexpr int width = 320, height = 240;

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = width, .height = height, .samples_a_side = 1});
  return made;
}

DisplayViewsOptions three_views(float span) {
  return {.views = 3, .width = width, .height = height, .span = span, .zero_parallax_px = 0};
}

TEST(PhotographViews, ShowWhatTheScenesOwnViewsShow) {
  // Three views over one eye separation: the eyes', and that between them.
  const std::vector<Image<Rgb8>> views = draw_photograph_views(still().pictures, still().geometry, three_views(1));
  ASSERT_EQ(views.size(), 3u);
  const Image<Rgb8> between =
      make_synthetic_view({.width = width, .height = height, .samples_a_side = 1}, central_view).picture;
  EXPECT_GT(psnr_db(views[0], still().pictures.left), 27);
  EXPECT_GT(psnr_db(views[1], between), 27);
  EXPECT_GT(psnr_db(views[2], still().pictures.right), 27);
  EXPECT_LT(psnr_db(views[1], still().pictures.left), 22);
}

TEST(PhotographViews, OfOnePictureAndItsDepthAreAsGood) {
  const MadePair made = make_pair_from_single_view(still().pictures.left, still().geometry.left_disparity);
  const std::vector<Image<Rgb8>> views = draw_photograph_views(made.pictures, made.geometry, three_views(1));
  EXPECT_GT(psnr_db(views[2], still().pictures.right), 24);
}

TEST(PhotographViews, LieInFramesOfAnotherShape) {
  DisplayViewsOptions options = three_views(2);
  options.width = 120;
  options.height = 240;
  options.framing.whole = true;
  for (const Image<Rgb8>& view : draw_photograph_views(still().pictures, still().geometry, options)) {
    EXPECT_EQ(view(60, 70), Rgb8{});
    EXPECT_EQ(view(60, 170), Rgb8{});
    EXPECT_NE(view(60, 80), Rgb8{});
  }
  // A frame whose pixels are shown twice as wide is half as wide.
  const auto square = draw_photograph_views(still().pictures, still().geometry, three_views(1));
  DisplayViewsOptions narrow = three_views(1);
  narrow.width = width / 2;
  const auto squeezed = draw_photograph_views(still().pictures, still().geometry, narrow, 0.5);
  for (const int x : {20, 80, 140}) {
    const int both = square[1](2 * x, 120).g + square[1](2 * x + 1, 120).g;
    EXPECT_NEAR(squeezed[1](x, 120).g, both / 2., 12);
  }
}

}  // namespace wheatstone::photograph_views_test
