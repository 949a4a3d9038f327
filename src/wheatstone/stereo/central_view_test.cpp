#include "wheatstone/stereo/central_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "throws_error.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::central_view_test {

const SyntheticStillOptions options{.width = 480, .height = 360};

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still(options);
  return made;
}

const SyntheticView& truth() {
  static const SyntheticView made = make_synthetic_view(options, central_view);
  return made;
}

/// Root mean square error, over the pixels where the mask is not 0.
double rms(const Image<Rgb8>& picture, const Image<std::uint8_t>* mask = nullptr) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    if (mask != nullptr && mask->pixels()[i] == 0) continue;
    const Rgb8 p = picture.pixels()[i], q = truth().picture.pixels()[i];
    sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
    count += 3;
  }
  return std::sqrt(sum / count);
}

/// 255 for the pixels of the central view that exactly one of the eyes sees, and those beside them on the row: right at
/// an edge all pictures mix colours.
Image<std::uint8_t> seen_by_one_eye() {
  const Image<float>& nearest = truth().disparity;
  Image<std::uint8_t> mask(nearest.width(), nearest.height());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const float d = nearest(x, y);
      const auto sees = [&](const Image<float>& eye, float step) {
        const int there = static_cast<int>(std::floor(static_cast<float>(x) + 0.5f + step * d));
        return there >= 0 && there < mask.width() && eye(there, y) <= d + 1;
      };
      if (sees(still().geometry.left_disparity, 0.5f) != sees(still().geometry.right_disparity, -0.5f))
        mask(x, y) = 255;
    }
  }
  Image<std::uint8_t> inner(mask.width(), mask.height());
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 2; x + 2 < mask.width(); ++x)
      if (std::ranges::all_of(mask.row(y).subspan(x - 2, 5), [](std::uint8_t m) { return m != 0; })) inner(x, y) = 255;
  return inner;
}

TEST(CentralView, IsWhatTheEyeBetweenTheEyesSees) {
  const CentralView centre = make_central_view(still().pictures, still().geometry);
  EXPECT_LT(rms(centre.picture), 9);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < centre.disparity.pixels().size(); ++i) {
    ASSERT_TRUE(std::isfinite(centre.disparity.pixels()[i]));
    if (std::abs(centre.disparity.pixels()[i] - truth().disparity.pixels()[i]) > 1) ++wrong;
  }
  EXPECT_LT(static_cast<double>(wrong) / static_cast<double>(centre.disparity.pixels().size()), 0.01);
}

TEST(CentralView, ShowsNoGhostsWhereOnlyOneEyeSees) {
  const Image<std::uint8_t> mask = seen_by_one_eye();
  const CentralView ours = make_central_view(still().pictures, still().geometry);
  const CentralView average = make_central_view(still().pictures, still().geometry, CentralMerge::average);
  EXPECT_LT(rms(ours.picture, &mask), 0.6 * rms(average.picture, &mask));
  EXPECT_LE(rms(ours.picture), rms(average.picture));
}

TEST(CentralView, TellsWhatItHidesFromEachEye) {
  const CentralView centre = make_central_view(still().pictures, still().geometry);
  const auto share = [](const Image<std::uint8_t>& mask) {
    return static_cast<double>(std::ranges::count(mask.pixels(), std::uint8_t{255})) /
           static_cast<double>(mask.pixels().size());
  };
  // About half of what one eye sees alone lies beyond the middle.
  const double left_alone = share(still().geometry.left_occlusion);
  EXPECT_GT(share(centre.left_only), 0.3 * left_alone);
  EXPECT_LT(share(centre.left_only), 0.7 * left_alone);
  const double right_alone = share(still().geometry.right_occlusion);
  EXPECT_GT(share(centre.right_only), 0.3 * right_alone);
  EXPECT_LT(share(centre.right_only), 0.7 * right_alone);
}

TEST(CentralView, OfTwoEqualPicturesIsThatPicture) {
  const Image<Rgb8>& picture = still().pictures.left;
  const int width = picture.width(), height = picture.height();
  const StereoGeometry flat{Image<float>(width, height), Image<float>(width, height),
                            Image<std::uint8_t>(width, height), Image<std::uint8_t>(width, height)};
  for (const CentralMerge merge : {CentralMerge::visible, CentralMerge::average}) {
    const CentralView centre = make_central_view({picture, picture}, flat, merge);
    EXPECT_TRUE(std::ranges::equal(centre.picture.pixels(), picture.pixels()));
    EXPECT_TRUE(std::ranges::all_of(centre.left_only.pixels(), [](std::uint8_t m) { return m == 0; }));
  }
}

TEST(CentralView, RefusesAGeometryOfAnotherSize) {
  StereoGeometry geometry = still().geometry;
  geometry.right_disparity = Image<float>(8, 8);
  expect_error(ErrorKind::bad_input, "pixels, expected the pictures",
               [&] { make_central_view(still().pictures, geometry); });
}

}  // namespace wheatstone::central_view_test
