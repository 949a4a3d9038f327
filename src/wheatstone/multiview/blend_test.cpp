// Particles that absorb as they shine, blended front to back.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wheatstone/image/colour.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/front_to_back_internal.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/random.h"

namespace wheatstone::blend_test {

/// A camera at 0 that looks along z; colours go from green at a temperature of 0 to red at 1.
Scene scene_of(const Cloud& cloud, float opacity, float size_px) {
  CloudStatistics statistics;
  statistics.add(cloud);
  Scene scene;
  scene.camera = {.focal_px = 60, .centre_x_px = 64, .centre_y_px = 32, .nearest_depth = 0.1f};
  scene.mapping.points = {{1, -8}, {3, 8}};
  Appearance appearance{.look = Look::thesis, .blend = Blend::over, .opacity = opacity};
  appearance.smallest_px = appearance.largest_px = size_px;
  appearance.logarithmic = false;
  appearance.coldest = 0;
  appearance.hottest = 1;
  appearance.cold = {0, 255, 0};
  appearance.hot = {255, 0, 0};
  appearance.density_slope = 0;
  scene.splat_style = make_splat_style(appearance, statistics);
  return scene;
}

Rig rig_of(int views) { return evenly_spaced(128, 64, views); }

std::vector<Image<Rgb8>> views_of(const Cloud& cloud, const Scene& scene, int views, Method method) {
  const RenderOptions options{.method = method, .filter = SliceFilter::centroid, .exposure = 1};
  return render(cloud, scene, rig_of(views), options).views;
}

void add(Cloud& cloud, std::array<float, 3> at, float temperature) {
  cloud.x.push_back(at[0]);
  cloud.y.push_back(at[1]);
  cloud.z.push_back(at[2]);
  cloud.temperature.push_back(temperature);
}

Cloud haze(std::uint64_t count) {
  Cloud cloud;
  const auto random = [](std::uint64_t i, std::uint64_t which) { return unit_float(hash_keys({i, which})); };
  for (std::uint64_t i = 0; i < count; ++i) {
    const float depth = 1 + 2 * random(i, 2);
    add(cloud, {depth * (2 * random(i, 0) - 1), depth * (random(i, 1) - 0.5f), depth}, (depth - 1) / 2);
  }
  return cloud;
}

TEST(Blend, OverShowsWhatComesThroughTheNearerParticle) {
  Cloud cloud;
  add(cloud, {0, 0, 3}, 1);  // the farther one, red, comes first in the file
  add(cloud, {0, 0, 1}, 0);
  for (const Method method : {Method::exact, Method::incremental, Method::layered}) {
    const Rgb8 middle = views_of(cloud, scene_of(cloud, 1, 24), 1, method)[0](64, 32);
    // The sigmoid of a slope of 0 is a half, and a pixel's own width flattens no splat as wide as these.
    const float through = std::exp(-0.5f);
    const auto shown = [](float light) { return static_cast<int>(srgb_from_linear(light)); };
    EXPECT_NEAR(middle.g, shown(1 - through), 3) << static_cast<int>(method);
    EXPECT_NEAR(middle.r, shown(through * (1 - through)), 3) << static_cast<int>(method);
    EXPECT_EQ(middle.b, 0);
    // Of dense ones the farther is not seen at all.
    EXPECT_LE(views_of(cloud, scene_of(cloud, 40, 24), 1, method)[0](64, 32).r, 3);
  }
}

TEST(Blend, OverAddsUpWhereThereIsNextToNothing) {
  const Cloud cloud = haze(400);
  Scene scene = scene_of(cloud, 2e-3f, 6);
  const CloudStatistics statistics;
  ToneSettings settings{.exposure = 100, .stretch = Stretch::linear};
  const ToneMap tone(settings);
  const Rig rig = rig_of(1);
  const ViewLight over = light_of_view({chunks_of(cloud), scene, rig, statistics, tone}, central_view);
  scene.splat_style.blend = Blend::add;
  const ViewLight sum = light_of_view({chunks_of(cloud), scene, rig, statistics, tone}, central_view);
  float most = 0;
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < rig.width; ++x)
      for (const int channel : {0, 1, 2}) {
        most = std::max(most, sum.row(y, channel)[x]);
        EXPECT_NEAR(over.row(y, channel)[x], sum.row(y, channel)[x], 1e-5f);
      }
  EXPECT_GT(most, 1e-3f);
}

TEST(Blend, OverIsTheSameIncrementallyAndNearlyInLayers) {
  const Cloud cloud = haze(4000);
  const Scene scene = scene_of(cloud, 1, 7);
  const auto exact = views_of(cloud, scene, 3, Method::exact);
  EXPECT_EQ(views_of(cloud, scene, 3, Method::incremental), exact);
  const auto layered = views_of(cloud, scene, 3, Method::layered);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    EXPECT_GT(measure_view(layered[v], exact[v]).psnr_db, 34) << v;
    EXPECT_LT(measure_view(layered[2 - v], exact[v == 1 ? 0 : v]).psnr_db, 28) << "another view must be told apart";
  }
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(views_of(cloud, scene, 3, Method::exact), exact);
  EXPECT_EQ(views_of(cloud, scene, 3, Method::layered), layered);
}

TEST(Blend, OverEndsWhereNothingMoreCanBeSeen) {
  Splat dense{.x = 30, .y = 16, .parallax = 0, .colour = {0, 0, 0x6400}, .size = 0x4f80};  // a depth of 1024, 30 pixels
  FrontToBack view(60, 32, 0, central_view);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 5; ++column) {
      dense.x = static_cast<float>(15 * column);
      dense.y = static_cast<float>(16 * row);
      view.blend(dense);
    }
  const std::uint64_t wall = view.fragments();
  EXPECT_GE(wall, 60u * 32u);
  for (int i = 0; i < 10000; ++i) view.blend(dense);
  EXPECT_EQ(view.fragments(), wall);
}

/// A bright slice far away, behind a black one in the middle of the view that lets half of the light through, or none.
SliceStack half_covered(float alpha) {
  SliceStack stack{
      .width = 200, .height = 20, .tone = {.look = Look::thesis, .exposure = 1, .stretch = Stretch::linear}};
  stack.slices.push_back(
      {.parallax_px = -3, .left = 60, .top = 2, .pixels = Image<LinearRgba>(80, 9, {0, 0, 0, alpha})});
  stack.slices.push_back(
      {.parallax_px = 6, .left = -20, .top = 0, .pixels = Image<LinearRgba>(240, 20, {0.8f, 0.4f, 0.2f, 1})});
  return stack;
}

TEST(HidingSlices, WhatIsBlackHidesWhatIsBehindIt) {
  const Rig rig = evenly_spaced(200, 20, 3);
  for (const SliceFilter filter : {SliceFilter::nearest, SliceFilter::linear, SliceFilter::centroid}) {
    const auto views = render_slices(half_covered(1), rig, filter);
    EXPECT_EQ(views[1](100, 5), (Rgb8{0, 0, 0}));
    EXPECT_EQ(views[1](100, 15), views[1](20, 5));
    EXPECT_GT(views[1](20, 5).r, 200);
    // Half an eye separation to either side, the black slice moves by 1.5 pixels.
    EXPECT_EQ(views[0](64, 5), (Rgb8{0, 0, 0}));
    EXPECT_EQ(views[2](135, 5), (Rgb8{0, 0, 0}));
    EXPECT_GT(views[0](141, 5).r + views[2](57, 5).r, 400);
    const auto through = render_slices(half_covered(0.5f), rig, filter);
    EXPECT_GT(through[1](100, 5).r, 100);
    EXPECT_LT(through[1](100, 5).r, through[1](20, 5).r);
  }
}

TEST(HidingSlices, SubPixelsShowTheirViews) {
  const Rig rig = evenly_spaced(200, 20, 9);
  const auto view_at = [](int x, int y, int channel) { return (3 * x + channel + 2 * y) % 9; };
  const auto views_of_row = [&](int y, auto three) {
    for (int i = 0; i < 3 * rig.width; ++i) three[i] = static_cast<std::uint16_t>(view_at(i / 3, y, i % 3));
  };
  const auto most_beside_views = [&](const SliceStack& stack, const std::optional<Focus>& focus) {
    const auto interleaved = render_interleaved(stack, rig.positions, views_of_row, {}, focus);
    const auto views = render_slices(stack, rig, SliceFilter::linear, {}, focus);
    int most = 0;
    for (int y = 0; y < rig.height; ++y)
      for (int x = 0; x < rig.width; ++x) {
        most = std::max(most, std::abs(interleaved.picture(x, y).r - views[view_at(x, y, 0)](x, y).r));
        most = std::max(most, std::abs(interleaved.picture(x, y).g - views[view_at(x, y, 1)](x, y).g));
        most = std::max(most, std::abs(interleaved.picture(x, y).b - views[view_at(x, y, 2)](x, y).b));
      }
    return most;
  };
  for (const float alpha : {0.5f, 1.f}) {
    EXPECT_LE(most_beside_views(half_covered(alpha), {}), 1) << alpha;
    EXPECT_LE(most_beside_views(half_covered(alpha), Focus{.x_px = 90, .y_px = 8, .radius_px = 40, .gain = 1.5f}), 1)
        << alpha;
  }
}

}  // namespace wheatstone::blend_test
