// More depth where the viewer looks.

#include "wheatstone/multiview/focus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "throws_error.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/random.h"

namespace wheatstone::focus_test {

constexpr int width = 256, height = 96;

Cloud haze() {
  Cloud cloud;
  const auto random = [](std::uint64_t i, std::uint64_t which) { return unit_float(hash_keys({i, which})); };
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const float depth = 1 + 2 * random(i, 2);
    cloud.x.push_back(1.6f * depth * (2 * random(i, 0) - 1));
    cloud.y.push_back(depth * (random(i, 1) - 0.5f));
    cloud.z.push_back(depth);
    cloud.temperature.push_back(1e4f * depth);
  }
  return cloud;
}

Scene scene_of(const Cloud& cloud, float parallax_px) {
  CloudStatistics statistics;
  statistics.add(cloud);
  Scene scene;
  scene.camera = {.focal_px = 90, .centre_x_px = width / 2.f, .centre_y_px = height / 2.f, .nearest_depth = 0.1f};
  scene.mapping.points = {{1, -parallax_px}, {3, parallax_px}};
  scene.splat_style = make_splat_style({.look = Look::thesis}, statistics);
  return scene;
}

std::vector<Image<Rgb8>> views_of(const Cloud& cloud, float parallax_px, std::optional<Focus> focus) {
  const RenderOptions options{
      .method = Method::layered, .filter = SliceFilter::centroid, .planes = 49, .focus = focus, .exposure = 0.5f};
  return render(cloud, scene_of(cloud, parallax_px), evenly_spaced(width, height, 3), options).views;
}

TEST(Focus, OfTheWholeScreenIsMoreDepth) {
  const Cloud cloud = haze();
  const Focus everywhere{.x_px = width / 2.f, .y_px = height / 2.f, .radius_px = 1e5f, .gain = 1.5f};
  const auto with_focus = views_of(cloud, 12, everywhere);
  const auto deeper = views_of(cloud, 18, {});
  const auto usual = views_of(cloud, 12, {});
  for (const std::size_t v : {0, 2}) {
    EXPECT_GT(measure_view(with_focus[v], deeper[v]).psnr_db, 45) << v;
    EXPECT_LT(measure_view(usual[v], deeper[v]).psnr_db, 35) << "another depth must be told apart";
  }
  EXPECT_EQ(with_focus[1], usual[1]) << "the central view has no depth";
}

TEST(Focus, ChangesNothingBeyondItsRadiusAndBlendsInAtIt) {
  const Cloud cloud = haze();
  const Focus focus{.x_px = 100, .y_px = 40, .radius_px = 60, .gain = 2};
  const auto with_focus = views_of(cloud, 12, focus);
  const auto usual = views_of(cloud, 12, {});
  const auto distance = [&](int x, int y) {
    return std::hypot(static_cast<float>(x) - 99.5f, static_cast<float>(y) - 39.5f);
  };
  int most_at_rim = 0;
  int most_inside = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int difference = std::abs(with_focus[0](x, y).g - usual[0](x, y).g);
      if (distance(x, y) >= 60) {
        EXPECT_LE(difference, 1) << x << ", " << y;
      }
      if (distance(x, y) > 57 && distance(x, y) < 60) most_at_rim = std::max(most_at_rim, difference);
      if (distance(x, y) < 20) most_inside = std::max(most_inside, difference);
    }
  EXPECT_GT(most_inside, 40);
  EXPECT_LE(most_at_rim, 6);
}

TEST(Focus, IsTheSameInSlicesAndForLenses) {
  const Cloud cloud = haze();
  const Focus focus{.x_px = 100, .y_px = 40, .radius_px = 60, .gain = 1.6f};
  const Rig rig = evenly_spaced(width, height, 3);
  const SliceStack stack =
      make_slices(cloud, scene_of(cloud, 12), rig,
                  {.filter = SliceFilter::centroid, .planes = 49, .focus = focus, .exposure = 0.5f}, {});
  EXPECT_GT(measure_view(render_slices(stack, rig, SliceFilter::centroid, {}, focus)[2], views_of(cloud, 12, focus)[2])
                .psnr_db,
            50);
  const auto views = render_slices(stack, rig, SliceFilter::linear, {}, focus);
  const InterleavedView last = render_interleaved(
      stack, rig.positions, [](int /*y*/, auto three) { std::ranges::fill(three, 2); }, {}, focus);
  EXPECT_GT(measure_view(last.picture, views[2]).psnr_db, 60);
  EXPECT_LT(measure_view(last.picture, render_slices(stack, rig, SliceFilter::linear)[2]).psnr_db, 40);
}

TEST(Focus, ThatWouldFoldAViewIsRefused) {
  const float shift = 12;
  for (const float gain : {0.f, 1.2f, 3.f}) {
    const float least = 1.5397f * std::abs(gain - 1) * shift;
    const Focus wide{.x_px = 300, .y_px = 0, .radius_px = least * 1.001f, .gain = gain};
    check_focus(wide, shift);
    for (const float moved : {-shift, shift})
      for (float x = 0; x < 600; x += 0.25f)
        EXPECT_GE(x + 0.25f + moved * wide.gain_at(x + 0.25f, 0), x + moved * wide.gain_at(x, 0));
    const Focus narrow{.x_px = 300, .y_px = 0, .radius_px = least * 0.99f, .gain = gain};
    expect_error(ErrorKind::wrong_usage, "--focus-radius", [&] { check_focus(narrow, shift); });
  }
  expect_error(ErrorKind::wrong_usage, "--focus-gain", [] { check_focus({.radius_px = 1e5f, .gain = 9}, 20); });
  const Cloud cloud = haze();
  expect_error(ErrorKind::wrong_usage, "--focus: the depth planes are moved", [&] {
    render(cloud, scene_of(cloud, 1), evenly_spaced(width, height, 2),
           {.method = Method::exact, .focus = Focus{.radius_px = 50}});
  });
}

}  // namespace wheatstone::focus_test
