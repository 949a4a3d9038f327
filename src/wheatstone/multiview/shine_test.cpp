// Highlights that move from view to view.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "needs_gpu.h"
#include "psnr.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/shine_internal.h"
#include "wheatstone/random.h"

namespace wheatstone::shine_test {

/// A ball of radius 1 around 0, densest in the middle.
Cloud ball(std::uint64_t count) {
  Cloud cloud;
  const auto random = [](std::uint64_t i, std::uint64_t which) { return unit_float(hash_keys({i, which})); };
  for (std::uint64_t i = 0; i < count; ++i) {
    const float away = std::sqrt(random(i, 0));
    const float azimuth = 6.2831853f * random(i, 1);
    const float height = 2 * random(i, 2) - 1;
    const float around = std::sqrt(1 - height * height);
    cloud.x.push_back(away * around * std::cos(azimuth));
    cloud.y.push_back(away * around * std::sin(azimuth));
    cloud.z.push_back(away * height);
    cloud.temperature.push_back(1e4f);
  }
  return cloud;
}

struct Stage {
  CloudStatistics statistics;
  Scene scene;
  Rig rig = evenly_spaced(160, 90, 5, 2);
};

/// All at the depth of the screen, so that nothing but highlights differs from view to view.
Stage stage_of(const Cloud& cloud, float parallax = 0) {
  Stage stage;
  stage.statistics.grid = std::make_shared<DensityGrid>();
  stage.statistics.add(cloud);
  stage.statistics.grid->finish();
  stage.scene.camera = camera_around({0, 0, 0}, 1.2f, 160, 90, {.orthographic = true});
  const float depth = stage.scene.camera.orthographic_depth;
  stage.scene.mapping.points = {{depth - 1.2f, -parallax}, {depth + 1.2f, parallax}};
  stage.scene.splat_style = make_splat_style({}, stage.statistics);
  stage.scene.splat_style.size_depth = depth;
  stage.scene.splat_style.fixed_radius = 0.1f;
  stage.scene.shine = {.strength = 10, .turn = 0.4f, .grid = stage.statistics.grid};
  return stage;
}

std::vector<Image<Rgb8>> views_of(const Cloud& cloud, const Stage& stage, Method method) {
  return render(chunks_of(cloud), stage.statistics, stage.scene, stage.rig, {.method = method}).views;
}

TEST(Shine, MovesOverABallAsTheEyeMoves) {
  const Cloud cloud = ball(20000);
  const Stage stage = stage_of(cloud);
  const ToneMap tone({.look = Look::mass, .least = 0, .most = 1});
  const Chunks chunks = chunks_of(cloud);
  Scene dull = stage.scene;
  dull.shine = {};
  const ViewLight without = light_of_view({chunks, dull, stage.rig, stage.statistics, tone}, central_view);
  struct Middle {
    double light = 0, x = 0, y = 0;
  };
  const auto highlight = [&](ViewPosition view) {
    Middle middle;
    const ViewLight with = light_of_view({chunks, stage.scene, stage.rig, stage.statistics, tone}, view);
    for (int y = 0; y < 90; ++y)
      for (int x = 0; x < 160; ++x) {
        const double light = with.row(y, 0)[x] - without.row(y, 0)[x];
        EXPECT_GE(light, -1e-4);
        middle.light += light;
        middle.x += x * light;
        middle.y += y * light;
      }
    middle.x /= middle.light;
    middle.y /= middle.light;
    return middle;
  };
  const Middle left = highlight(ViewPosition(-1.f));
  const Middle centre = highlight(central_view);
  const Middle right = highlight(ViewPosition(1.f));
  // It stands at the upper left, where the lamp is, and follows the eye by a part of the ball's radius.
  EXPECT_LT(centre.x, 78);
  EXPECT_LT(centre.y, 43);
  EXPECT_GT(centre.x, left.x + 2);
  EXPECT_GT(right.x, centre.x + 2);
  EXPECT_NEAR(left.y, right.y, 3);
}

TEST(Shine, IsTheSameIncrementallyAndNearlyInLayers) {
  const Cloud cloud = ball(20000);
  const Stage stage = stage_of(cloud, 8);
  const auto exact = views_of(cloud, stage, Method::exact);
  const auto incremental = views_of(cloud, stage, Method::incremental);
  const auto layered = views_of(cloud, stage, Method::layered);
  Stage dull = stage;
  dull.scene.shine = {};
  const auto without = views_of(cloud, dull, Method::exact);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    EXPECT_EQ(incremental[v], exact[v]) << v;
    EXPECT_GT(measure_view(layered[v], exact[v]).psnr_db, 44) << v;
    EXPECT_LT(measure_view(without[v], exact[v]).psnr_db, 40) << "the highlight must be told apart, view " << v;
  }
}

TEST(Shine, IsNoMass) {
  const Cloud cloud = ball(2000);
  Stage stage = stage_of(cloud);
  const auto values = [&] { return view_values(chunks_of(cloud), stage.statistics, stage.scene, stage.rig)[0].column; };
  const Image<float> shining = values();
  stage.scene.shine = {};
  EXPECT_EQ(shining, values());
}

TEST(Shine, IsInterpolatedBetweenViewsThatAreCloseEnough) {
  const std::vector<ViewPosition> views = evenly_spaced(1, 1, 9, 4).positions;
  const std::vector<ViewPosition> keys = shine_keys({.strength = 1, .turn = 0.087f}, views);
  EXPECT_EQ(keys.front(), views.front());
  EXPECT_EQ(keys.back(), views.back());
  EXPECT_GE(keys.size(), 3u);
  EXPECT_LE(keys.size(), 5u);
  const auto shares = shares_of_keys(keys, views);
  for (std::size_t v = 0; v < views.size(); ++v) {
    float sum = 0;
    float at = 0;
    for (std::size_t key = 0; key < keys.size(); ++key) {
      sum += shares[v][key];
      at += shares[v][key] * keys[key].eye_separations();
    }
    EXPECT_NEAR(sum, 1, 1e-6);
    EXPECT_NEAR(at, views[v].eye_separations(), 1e-5);
  }
  EXPECT_EQ(shine_keys({.strength = 1, .turn = 0.087f}, std::vector{central_view}).size(), 1u);
}

class ShineGpu : public NeedsGpu {};

TEST_F(ShineGpu, ShinesAsTheProcessorDoes) {
  const Cloud cloud = ball(4000);
  Stage stage = stage_of(cloud, 8);
  RenderOptions options{.device = Device::graphics, .tone = {.least = 0, .most = 40}};
  const auto views = [&] { return render(chunks_of(cloud), stage.statistics, stage.scene, stage.rig, options).views; };
  const std::vector<Image<Rgb8>> found = views();
  options.device = Device::processor;
  options.method = Method::incremental;
  EXPECT_GT(worst_psnr(found, views()), 55);
  stage.scene.shine = {};
  EXPECT_LT(worst_psnr(found, views()), 45);
}

}  // namespace wheatstone::shine_test
