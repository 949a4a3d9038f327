#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <string>

#include "scenes/model_scene.h"
#include "throws_error.h"
#include "wheatstone/multiview/render_model.h"
#include "wheatstone/multiview/triangle_band_internal.h"
#include "wheatstone/synthetic/synthetic_models.h"

namespace wheatstone::model_views_test {

constexpr int width = 160, height = 120;

DepthMapping three_regions(const DepthMapping& ends, bool smooth) {
  const auto [near, far] = std::pair{ends.points.front().depth, ends.points.back().depth};
  const DepthMapping regions{
      {{near, -20}, {near + 0.4f * (far - near), -15}, {near + 0.6f * (far - near), 15}, {far, 20}}};
  return smooth ? monotone_curve(regions) : regions;
}

struct Case {
  std::string name;
  Model model;
  Framing framing = {};
  bool regions = false, smooth = false;
  float shine = 0;
  int samples = 4;
};

std::vector<Case> cases() {
  return {{"knot", make_knot(3000)},
          {"knot of small triangles, with a smooth mapping", make_knot(60'000), {}, true, true},
          {"knot that shines, 8 samples", make_knot(3000), {}, false, false, 1, 8},
          {"city in regions", make_city(3000), {.zoom = 1.5f}, true},
          {"city from within", make_city(3000), {.elevation_deg = 3, .zoom = 0.2f, .look_at = {{9, 1, 0}}}, true},
          {"orthographic city", make_city(3000), {.orthographic = true}, true, true},
          {"textured sphere", make_textured_sphere(2000)},
          {"tree", make_tree(30'000)}};
}

ModelScene scene_for(const Case& one) {
  ModelScene scene = scene_around(one.model, width, height, one.framing);
  if (one.regions) scene.mapping = three_regions(scene.mapping, one.smooth);
  scene.look.shine = one.shine;
  scene.look.samples = one.samples;
  return scene;
}

const Rig& rig() {
  static const Rig five = evenly_spaced(width, height, 5, 3);
  return five;
}

TEST(ModelViews, IncrementalIsExactToTheByte) {
  for (const Case& one : cases()) {
    const ModelScene scene = scene_for(one);
    const RenderedModel exact = render_model(one.model, scene, rig(), {.method = Method::exact, .geometry = true});
    const RenderedModel incremental = render_model(one.model, scene, rig(), {.geometry = true});
    ASSERT_EQ(exact.method, Method::exact);
    ASSERT_EQ(incremental.method, Method::incremental);
    EXPECT_TRUE(exact.views == incremental.views) << one.name;
    EXPECT_NE(exact.views.front(), exact.views.back()) << one.name;
    for (std::size_t v = 0; v < exact.views.size(); ++v)
      EXPECT_EQ(0, std::memcmp(exact.depth[v].pixels().data(), incremental.depth[v].pixels().data(),
                               exact.depth[v].pixels().size_bytes()))
          << one.name;
  }
}

TEST(ModelViews, SameBytesOnAnyNumberOfThreads) {
  const Case one{"tree", make_tree(30'000)};
  const ModelScene scene = scene_for(one);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return render_model(one.model, scene, rig()).views;
  };
  EXPECT_EQ(with_threads(1), with_threads(7));
}

/// A sheet that is wider than all views, of triangles of odd shapes, with hills of the given height.
Model sheet(double hills) {
  Model model;
  model.materials.resize(1);
  constexpr std::uint32_t side = 60;
  for (std::uint32_t j = 0; j <= side; ++j) {
    for (std::uint32_t i = 0; i <= side; ++i) {
      const double bend = std::sin(12.9 * i + 78.2 * j) * 43758.5;
      const double random = bend - std::floor(bend);
      model.positions.push_back({0.1 * (i + 0.4 * random) - 3, 0.1 * (j - 0.4 * random) - 3, hills * random});
      model.normals.push_back({0, 0, 1});
    }
  }
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
      if ((i + j) % 2 == 0) {
        model.triangles.push_back({a, b, c});
        model.triangles.push_back({b, d, c});
      } else {
        model.triangles.push_back({a, b, d});
        model.triangles.push_back({a, d, c});
      }
    }
  }
  model.material_of.assign(model.triangles.size(), 0);
  return model;
}

/// Looks down on a sheet.
ModelScene over_sheet(bool regions) {
  ModelScene scene;
  scene.camera = {.position = {0, 0, 3}, .right = {1, 0, 0}, .down = {0, -1, 0}, .forward = {0, 0, -1}};
  scene.camera.focal_px = 150;
  scene.camera.centre_x_px = width / 2.f;
  scene.camera.centre_y_px = height / 2.f;
  scene.camera.nearest_depth = 0.01f;
  scene.mapping = {{{2, -20}, {3.1f, 20}}};
  if (regions) scene.mapping = three_regions(scene.mapping, true);
  return scene;
}

/// Draws triangles with their numbers in the order given, or from last to first.
TriangleBand drawn(const ScreenTriangles& triangles, double view, bool backwards = false) {
  TriangleBand band(width, 4);
  band.begin(0, height);
  for (std::size_t i = 0; i < triangles.triangles.size(); ++i) {
    const std::size_t t = backwards ? triangles.triangles.size() - 1 - i : i;
    band.add(triangles.triangles[t], static_cast<std::uint32_t>(t), false);
  }
  band.show(static_cast<float>(view));
  return band;
}

TEST(ModelViews, NoGapsBetweenNeighboursInAnyView) {
  const Model model = sheet(0.9);
  for (const bool regions : {false, true}) {
    const ModelScene scene = over_sheet(regions);
    const Rig many = evenly_spaced(width, height, 21, 4);
    const ScreenTriangles triangles = screen_triangles(model, scene, DepthKnots(scene.mapping, scene.camera), many);
    EXPECT_EQ(triangles.parts.size() > 100, regions);
    for (const ViewPosition view : many.positions) {
      const TriangleBand band = drawn(triangles, static_cast<double>(view.eye_separations()));
      int gaps = 0;
      for (int row = 0; row < height; ++row)
        for (int k = 0; k < 4; ++k)
          for (const std::uint32_t shown : band.line(row, k)) gaps += shown == TriangleBand::nothing ? 1 : 0;
      EXPECT_EQ(gaps, 0) << "view " << view.eye_separations() << (regions ? " in regions" : "");
    }
  }
}

TEST(ModelViews, EverySampleBelongsToOneOfTwoNeighbours) {
  // All of it at one depth: where triangles overlapped, the first to be drawn would be seen.
  const Model model = sheet(0);
  const ModelScene scene = over_sheet(false);
  const Rig many = evenly_spaced(width, height, 5, 4);
  const ScreenTriangles triangles = screen_triangles(model, scene, DepthKnots(scene.mapping, scene.camera), many);
  for (const ViewPosition view : many.positions) {
    const TriangleBand forwards = drawn(triangles, static_cast<double>(view.eye_separations()));
    const TriangleBand backwards = drawn(triangles, static_cast<double>(view.eye_separations()), true);
    for (int row = 0; row < height; ++row)
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::ranges::equal(forwards.line(row, k), backwards.line(row, k)));
  }
}

TEST(ModelViews, ASmoothMappingIsFollowedToASixteenthOfAPixel) {
  for (const bool orthographic : {false, true}) {
    const Model model = make_city(3000);
    ModelScene scene = scene_around(model, width, height, {.orthographic = orthographic});
    scene.mapping = three_regions(scene.mapping, true);
    const RenderedModel rendered = render_model(model, scene, rig(), {.geometry = true});
    double worst = 0;
    for (std::size_t v = 0; v < rendered.views.size(); ++v) {
      for (std::size_t i = 0; i < rendered.depth[v].pixels().size(); ++i) {
        const float depth = rendered.depth[v].pixels()[i], disparity = rendered.disparity[v].pixels()[i];
        if (std::isnan(depth)) continue;
        worst = std::max(worst, static_cast<double>(std::abs(disparity + parallax_px(scene.mapping, depth))));
      }
    }
    RecordProperty("worst_px", std::to_string(worst));
    EXPECT_LT(worst, 1. / 16) << (orthographic ? "orthographic" : "perspective");
    EXPECT_GT(worst, 1e-4);
  }
}

TEST(ModelViews, ATextureLiesWhereItsPlacesSay) {
  Model model;  // a square that fills the view, its texture's left half red and its lower half dark
  model.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  model.normals.assign(4, {0, 0, 1});
  model.texture_places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  model.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.material_of = {0, 0};
  model.materials.push_back({"square", {1, 1, 1}, 0});
  Image<Rgb8> texture(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::uint8_t light = y < 32 ? 250 : 90;
      texture(x, y) = x < 32 ? Rgb8{light, 0, 0} : Rgb8{0, 0, light};
    }
  model.textures.push_back(texture);
  ModelScene scene = over_sheet(false);
  scene.camera.focal_px = 170;
  const Image<Rgb8> view = render_model(model, scene, evenly_spaced(width, height, 1)).views[0];
  const Rgb8 upper_left = view(60, 40), upper_right = view(100, 40), lower_left = view(60, 80);
  EXPECT_GT(upper_left.r, 150);
  EXPECT_EQ(upper_left.b, 0);
  EXPECT_GT(upper_right.b, 150);
  EXPECT_EQ(upper_right.r, 0);
  EXPECT_GT(lower_left.r, 20);
  EXPECT_LT(lower_left.r, upper_left.r / 2);
}

/// A square with a texture, that leans away from the camera, of 2·side² triangles.
Model leaning_square(std::uint32_t side) {
  Model model;
  for (std::uint32_t j = 0; j <= side; ++j) {
    for (std::uint32_t i = 0; i <= side; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(side),
                  v = static_cast<float>(j) / static_cast<float>(side);
      model.positions.push_back({2. * u - 1, 2. * v - 1, -0.8 * v});
      model.normals.push_back({0, 0.37f, 0.93f});
      model.texture_places.push_back({u, v});
      if (i == side || j == side) continue;
      const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
      model.triangles.push_back({a, a + 1, b + 1});
      model.triangles.push_back({a, b + 1, b});
    }
  }
  model.material_of.assign(model.triangles.size(), 0);
  model.materials.push_back({"square", {1, 1, 1}, 0});
  Image<Rgb8> texture(512, 512);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x)
      texture(x, y) = (x / 16 + y / 16) % 2 == 0 ? Rgb8{200, static_cast<std::uint8_t>(x / 2), 40} : Rgb8{60, 90, 160};
  model.textures.push_back(std::move(texture));
  return model;
}

TEST(ModelViews, SmallTrianglesWithATextureLookLikeLargeOnes) {
  const ModelScene scene = over_sheet(false);
  const Rig three = evenly_spaced(width, height, 3, 2);
  const auto of_large = render_model(leaning_square(1), scene, three).views;
  const auto of_small = render_model(leaning_square(20), scene, three).views;  // of 5 px
  for (std::size_t v = 0; v < of_large.size(); ++v) {
    // Pixels on edges of triangles read the texture in more places.
    double sum = 0;
    for (std::size_t i = 0; i < of_large[v].pixels().size(); ++i) {
      const Rgb8 a = of_large[v].pixels()[i], b = of_small[v].pixels()[i];
      sum += std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
    }
    EXPECT_LT(sum / (3. * width * height), 0.7) << v;
  }
}

TEST(ModelViews, ASideThatOnlyAnOuterViewSeesIsLitAsThatSide) {
  // A wall whose left side looks at the lamp. The central view sees a little of its right side, which is in the shade,
  // and the left view all of its left side.
  Model model;
  model.positions = {{0.02, 1, 0}, {0.02, -1, 0}, {0, 1, 1}, {0, -1, 1}};
  model.normals.assign(4, {-1, 0, 0});
  model.triangles = {{0, 1, 2}, {1, 3, 2}};
  model.material_of = {0, 0};
  model.materials.resize(1);
  const ModelScene scene = over_sheet(false);
  const RenderedModel rendered = render_model(model, scene, evenly_spaced(width, height, 3, 2));
  const auto brightest = [&](std::size_t view) {
    int most = 0;
    for (const Rgb8 pixel : rendered.views[view].pixels())
      if (pixel != scene.look.background) most = std::max(most, int{pixel.g});
    return most;
  };
  EXPECT_GT(std::abs(brightest(0) - brightest(2)), 40);
}

TEST(ModelViews, WhatIsBehindTheCameraIsNotSeen) {
  const Model model = make_knot(1000);
  ModelScene scene = scene_around(model, width, height);
  for (float& part : scene.camera.position) part *= 3;
  for (float& part : scene.camera.forward) part = -part;
  const RenderedModel rendered = render_model(model, scene, rig(), {.geometry = true});
  EXPECT_EQ(rendered.drawn_triangles, 0u);
  for (const Rgb8 pixel : rendered.views[2].pixels()) ASSERT_EQ(pixel, scene.look.background);
  for (const float depth : rendered.depth[2].pixels()) ASSERT_TRUE(std::isnan(depth));
}

TEST(ModelViews, WhatReachesBehindTheCameraIsCutOffThere) {
  Model model;  // a ground on which the camera stands
  model.positions = {{-1000, -1000, 0}, {1000, -1000, 0}, {1000, 1000, 0}, {-1000, 1000, 0}};
  model.normals.assign(4, {0, 0, 1});
  model.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.material_of = {0, 0};
  model.materials.resize(1);
  ModelScene scene;
  scene.camera = {.position = {0, 0, 1}, .right = {0, -1, 0}, .down = {0, 0, -1}, .forward = {1, 0, 0}};
  scene.camera.focal_px = 150;
  scene.camera.centre_x_px = width / 2.f;
  scene.camera.centre_y_px = height / 2.f;
  scene.camera.nearest_depth = 0.001f;
  scene.mapping = {{{1, -20}, {100, 20}}};
  const RenderedModel rendered = render_model(model, scene, rig(), {.geometry = true});
  for (std::size_t v = 0; v < 5; ++v) {
    for (int x = 0; x < width; ++x) {
      for (int y = height / 2 + 1; y < height; ++y) {
        // Between the depths at the pixel's upper and lower edge.
        const float below_px = static_cast<float>(y) - height / 2.f;
        ASSERT_LT(rendered.depth[v](x, y), 150.5f / below_px) << x << "," << y;
        ASSERT_GT(rendered.depth[v](x, y), 149.5f / (below_px + 1)) << x << "," << y;
      }
      for (int y = 0; y < height / 2 - 1; ++y) ASSERT_TRUE(std::isnan(rendered.depth[v](x, y)));
    }
  }
}

TEST(ModelViews, CoordinatesFarFromTheOriginMakeTheSamePicture) {
  Model model = make_knot(3000);
  const ModelScene scene = scene_around(model, width, height);
  const Image<Rgb8> near = render_model(model, scene, evenly_spaced(width, height, 1)).views[0];
  constexpr double far = 1 << 23;  // sums with it are exact to 2⁻²⁹
  for (auto& position : model.positions)
    for (double& coordinate : position) coordinate += far;
  ModelScene far_scene = scene;
  for (double& coordinate : far_scene.origin) coordinate += far;
  const Image<Rgb8> moved = render_model(model, far_scene, evenly_spaced(width, height, 1)).views[0];
  std::size_t differ = 0;
  for (std::size_t i = 0; i < near.pixels().size(); ++i) differ += near.pixels()[i] == moved.pixels()[i] ? 0 : 1;
  EXPECT_LT(differ, near.pixels().size() / 200);
}

TEST(ModelViews, OptionsWithoutSenseAreRefused) {
  const Model model = make_knot(1000);
  ModelScene scene = scene_around(model, width, height);
  expect_error(ErrorKind::wrong_usage, "expected exact or incremental",
               [&] { render_model(model, scene, rig(), {.method = Method::layered}); });
  scene.look.samples = 3;
  expect_error(ErrorKind::wrong_usage, "expected 4 or 8", [&] { render_model(model, scene, rig()); });
  scene.look.samples = 4;
  scene.mapping.points.back().parallax_px = 1e6f;
  expect_error(ErrorKind::wrong_usage, "parallax", [&] { render_model(model, scene, rig()); });
}

}  // namespace wheatstone::model_views_test
