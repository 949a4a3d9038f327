#include "wheatstone/painting/other_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "throws_error.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {
namespace {

const SyntheticStillOptions still_options{.width = 320, .height = 240, .samples_a_side = 1};

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still(still_options);
  return made;
}

double mean_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
  }
  return sum / (3.0 * static_cast<double>(a.pixels().size()));
}

class OtherViews : public testing::TestWithParam<const char*> {
 protected:
  Painting painting() const { return plan_painting(still().pictures, still().geometry, style_by_name(GetParam())); }
};

TEST_P(OtherViews, OfTheEyesAreTheEyes) {
  const Painting painted = painting();
  const std::vector<DrawnView> views = draw_other_views(painted, std::vector{left_eye, right_eye});
  EXPECT_EQ(views[1].picture, draw(painted, right_eye).picture);
  // Regions that the right eye alone sees lie under the left eye's, and show through gaps.
  EXPECT_LT(mean_difference(views[0].picture, draw(painted, left_eye).picture), 0.2);
}

TEST_P(OtherViews, AreAsTrueAsTheEyes) {
  const Painting painted = painting();
  const double at_eye = mean_difference(draw(painted, left_eye).picture, still().pictures.left);
  for (const float position : {-1.25f, -0.25f, 0.f, 0.25f, 1.25f}) {
    const ViewPosition view(position);
    const DrawnView drawn = draw_other_views(painted, std::vector{view}).front();
    const Image<Rgb8> truth = make_synthetic_view(still_options, view).picture;
    const bool between = std::abs(position) <= 0.5f;
    // Curves have no colours of their own for what comes into sight: those beside it diffuse there.
    const bool curves = painted.curves.width > 0;
    const double most = between ? (curves ? 1.2 : 1.15) : (curves ? 1.8 : 1.45);
    EXPECT_LT(mean_difference(drawn.picture, truth), most * at_eye) << position;
    EXPECT_LT(drawn.bare_share, between ? 0.01 : 0.06) << position;
    // The naive way: an eye's picture as it is.
    EXPECT_GT(mean_difference(draw(painted, left_eye).picture, truth), mean_difference(drawn.picture, truth))
        << position;
  }
}

TEST_P(OtherViews, DoNotJump) {
  std::vector<ViewPosition> positions;
  for (int i = 0; i <= 20; ++i) positions.emplace_back(-0.5f + 0.05f * static_cast<float>(i));
  const std::vector<DrawnView> views = draw_other_views(painting(), positions);
  std::vector<double> steps;
  for (std::size_t i = 1; i < views.size(); ++i)
    steps.push_back(mean_difference(views[i - 1].picture, views[i].picture));
  std::vector<double> sorted = steps;
  std::ranges::sort(sorted);
  EXPECT_LT(sorted.back(), 1.6 * sorted[sorted.size() / 2]);
}

INSTANTIATE_TEST_SUITE_P(Of, OtherViews, testing::Values("posterise", "mosaic", "diffusion"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST(OtherViewsOfStrokes, AreRefused) {
  Painting strokes;
  strokes.strokes = {10, 10};
  expect_error(ErrorKind::wrong_usage, "expected regions or curves",
               [&] { draw_other_views(strokes, std::vector{central_view}); });
}

}  // namespace
}  // namespace wheatstone
