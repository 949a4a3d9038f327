#include "wheatstone/app/slices_of_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "psnr.h"
#include "throws_error.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::slices_of_pictures_test {

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still({.width = 320, .height = 240, .samples_a_side = 2});
  return made;
}

const Painting& painting_of_still() {
  static const Painting painting = plan_painting(still().pictures, still().geometry, style_by_name("impressionist"));
  return painting;
}

Image<Rgb8> view_of(const SliceStack& stack, float position) {
  const Rig rig{.width = stack.width, .height = stack.height, .positions = {ViewPosition(position)}};
  return render_slices(stack, rig).front();
}

/// The share of pixels that nothing lies in: they are black, which no paint is.
double empty_share(const Image<Rgb8>& picture) {
  return static_cast<double>(std::ranges::count(picture.pixels(), Rgb8{0, 0, 0})) /
         static_cast<double>(picture.pixels().size());
}

TEST(SlicesOfAPainting, ShowItsViews) {
  const SliceStack stack = slices_of(pictures_on_surfaces(painting_of_still()), 0.f);
  EXPECT_GT(stack.slices.size(), 8);
  EXPECT_GE(stack.span, 2);
  for (const float position : {-1.f, -0.5f, 0.f, 0.5f, 1.f}) {
    SCOPED_TRACE(position);
    const Image<Rgb8> wanted = present(painting_of_still(), {.views = {ViewPosition(position)}}).views.front();
    const Image<Rgb8> shown = view_of(stack, position);
    RecordProperty("psnr", std::to_string(psnr_db(shown, wanted)));
    EXPECT_GT(psnr_db(shown, wanted), 23);
    RecordProperty("empty", std::to_string(empty_share(shown)));
    EXPECT_LT(empty_share(shown), 0.003);
    // A view from elsewhere is another picture.
    EXPECT_LT(psnr_db(view_of(stack, position + 0.5f), wanted), psnr_db(shown, wanted) - 3);
  }
}

TEST(SlicesOfAPhotograph, ShowWhatItsEyesSee) {
  constexpr ViewRange wanted{ViewPosition(-1.f), ViewPosition(1.f)};
  const SliceStack stack = slices_of(pictures_on_surfaces(still().pictures, still().geometry, wanted), 0.f);
  EXPECT_GT(psnr_db(view_of(stack, -0.5f), still().pictures.left), 40);
  EXPECT_GT(psnr_db(view_of(stack, 0.5f), still().pictures.right), 23);
  for (const float position : {-0.5f, 0.f, 0.5f}) EXPECT_LT(empty_share(view_of(stack, position)), 0.001) << position;
}

TEST(SlicesOfAPainting, HaveTheScreenPlaneWhereItIsWanted) {
  const SliceStack as_it_is = slices_of(pictures_on_surfaces(painting_of_still()), 0.f),
                   moved = slices_of(pictures_on_surfaces(painting_of_still()), 7.f);
  ASSERT_EQ(as_it_is.slices.size(), moved.slices.size());
  for (std::size_t i = 0; i < moved.slices.size(); ++i)
    EXPECT_NEAR(moved.slices[i].parallax_px - as_it_is.slices[i].parallax_px, 7, 1e-3);
  const SliceStack middle = slices_of(pictures_on_surfaces(painting_of_still()));
  EXPECT_NEAR(middle.slices.front().parallax_px, -middle.slices.back().parallax_px, 1);
}

TEST(SlicesOfAPainting, TakeWildSurfacesWithoutHarm) {
  Painting wild = painting_of_still();
  Image<float> disparity(320, 240, 4);
  for (int x = 0; x < 320; ++x) disparity(x, 9) = x % 2 == 0 ? 5e7f : -5e7f;
  wild.surfaces.seen.front().disparity = KnownRuns(disparity);
  wild.surfaces.seen.back().view = ViewPosition(1000.f);
  wild.surfaces.seen.back().left_px = 65535;
  EXPECT_LE(slices_of(pictures_on_surfaces(wild)).slices.size(), 64);
}

TEST(SlicesOfAPainting, AreRefusedWithoutSurfaces) {
  Painting apart = painting_of_still();
  apart.surfaces.seen.clear();
  expect_error(ErrorKind::bad_input, "has no surfaces", [&] { slices_of(pictures_on_surfaces(apart)); });
}

}  // namespace wheatstone::slices_of_pictures_test
