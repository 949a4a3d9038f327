// A painting that follows its disparities before it is planned again.

#include "wheatstone/painting/follow_disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <span>
#include <vector>

#include "scenes/still_life.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/retouch.h"

namespace wheatstone::follow_disparity_test {

constexpr int width = 320, height = 240;
const Touch nearer{.kind = Retouch::shift, .x = 90, .y = 60, .radius_px = 40, .amount = 6};

const SyntheticStill& still() { return still_life(width, height); }

/// The true disparity, which the touch makes of a wrong one.
const Image<float>& touched() { return still().geometry.left_disparity; }

Image<float> wrong() {
  Image<float> disparity = touched();
  Touch farther = nearer;
  farther.amount = -nearer.amount;
  retouch_disparity({&farther, 1}, still().pictures.left, disparity);
  return disparity;
}

Painting planned(Image<float> left_disparity) {
  return plan_painting(still().pictures, geometry_from_left(std::move(left_disparity)), style_by_name("oil"));
}

const Painting& before() {
  static const Painting painting = planned(wrong());
  return painting;
}

Painting followed() {
  Painting painting = before();
  follow_disparity(wrong(), touched(), painting);
  return painting;
}

/// Mean difference of a painting from what the right eye's photograph shows, in levels, in a square around the touch.
double error_in_right(const Painting& painting) {
  const Image<Rgb8> painted = std::move(present(painting, {.views = {right_eye}}).views.front());
  constexpr int reach = 45;
  double sum = 0;
  for (int y = static_cast<int>(nearer.y) - reach; y < static_cast<int>(nearer.y) + reach; ++y)
    for (int x = static_cast<int>(nearer.x) - reach; x < static_cast<int>(nearer.x) + reach; ++x) {
      const Rgb8 is = painted(x, y), wanted = still().pictures.right(x, y);
      sum += std::abs(is.r - wanted.r) + std::abs(is.g - wanted.g) + std::abs(is.b - wanted.b);
    }
  return sum / (3 * 4 * reach * reach);
}

TEST(FollowDisparity, ShowsWhatIsCorrectedAsPlanningAgainWould) {
  const double wrong_depth = error_in_right(before()),
               planned_again = error_in_right(planned(copy_of<float>(touched())));
  EXPECT_LT(error_in_right(followed()), 0.75 * planned_again + 0.25 * wrong_depth);
}

TEST(FollowDisparity, MovesStrokesOfTheTouchedPlaceAndNoOthers) {
  const Painting moved = followed();
  std::size_t moves = 0;
  for (std::size_t i = 0; i < layers_of(moved).size(); ++i) {
    const Layer &from = layers_of(before())[i], &to = layers_of(moved)[i];
    for (std::size_t k = 0; k < to.strokes.size(); ++k) {
      const Stroke &was = from.strokes[k], &is = to.strokes[k];
      for (std::size_t j = 0; j < is.point_count; ++j) {
        const ControlPoint &old = from.points_of(was)[j], &point = to.points_of(is)[j];
        if (point == old) continue;
        ++moves;
        const float column = x_in_view(old, was.reference_view, left_eye);
        ASSERT_LE(std::hypot(column - nearer.x, old.y - nearer.y), nearer.radius_px + 1);
        ASSERT_NEAR(x_in_view(point, is.reference_view, left_eye), column, 1e-3f);
        ASSERT_NEAR(point.disparity, touched()(static_cast<int>(column), static_cast<int>(old.y)),
                    moved.surfaces.tolerance_px);
      }
    }
  }
  EXPECT_GT(moves, 100U);
}

TEST(FollowDisparity, LeavesWhatAnotherSurfaceHides) {
  Painting painting = before();
  Layer& layer = std::get<StrokePainting>(painting.marks).layers.back();
  const float under = wrong()(90, 60) - 3 * painting.surfaces.tolerance_px;
  layer.points.push_back({90.5f, 60.5f, under});
  layer.strokes.push_back(
      {.first_point = static_cast<std::uint32_t>(layer.points.size() - 1), .point_count = 1, .disparity = under});
  follow_disparity(wrong(), touched(), painting);
  EXPECT_EQ(layers_of(painting).back().points.back(), (ControlPoint{90.5f, 60.5f, under}));
}

TEST(FollowDisparity, ChangesNothingWhereNothingChanges) {
  Painting painting = before();
  follow_disparity(touched(), touched(), painting);
  EXPECT_EQ(painting, before());
}

}  // namespace wheatstone::follow_disparity_test
