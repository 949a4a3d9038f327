#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "scenes/model_scene.h"
#include "wheatstone/multiview/render_model.h"
#include "wheatstone/multiview/triangle_band_internal.h"
#include "wheatstone/synthetic/synthetic_models.h"

// The renderer against rays that Embree casts: through the places of the samples, from where a view is taken.

namespace wheatstone::model_rays_test {

constexpr int width = 200, height = 150;

/// Rays from the eye of a view. Where the mapping has two points, parallax is a + b/depth: the view at v is that of a
/// camera v·b/f to the right, whose picture is moved by v·a.
class Rays {
 public:
  /// Triangles in the camera's coordinates, three corners each.
  Rays(const std::vector<std::array<float, 3>>& corners, const ModelScene& scene) : camera_(scene.camera) {
    const DepthMapping::Point near = scene.mapping.points.front(), far = scene.mapping.points.back();
    by_nearness_ = static_cast<double>(far.parallax_px - near.parallax_px) / (1. / far.depth - 1. / near.depth);
    constant_ = static_cast<double>(near.parallax_px) - by_nearness_ / static_cast<double>(near.depth);
    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const places = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners.size()));
    auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), corners.size() / 3));
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) places[3 * i + axis] = corners[i][axis];
      indices[i] = static_cast<unsigned>(i);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  Rays(const Rays&) = delete;
  Rays& operator=(const Rays&) = delete;
  ~Rays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Depth of the nearest triangle at a place of a view; infinite where there is none.
  float depth(double x, double y, double view) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    const auto focal = static_cast<double>(camera_.focal_px);
    ray.ray.org_x = static_cast<float>(-view * by_nearness_ / focal);
    ray.ray.dir_x = static_cast<float>((x - view * constant_ - static_cast<double>(camera_.centre_x_px)) / focal);
    ray.ray.dir_y = static_cast<float>((y - static_cast<double>(camera_.centre_y_px)) / focal);
    ray.ray.dir_z = 1;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : ray.ray.tfar;
  }

 private:
  Camera camera_;
  double by_nearness_ = 0, constant_ = 0;
  RTCDevice device_;
  RTCScene scene_;
};

using Corners = std::vector<std::array<float, 3>>;

/// Corners of the model itself.
Corners own_corners(const Model& model, const ModelScene& scene) {
  Corners corners;
  for (const auto& triangle : model.triangles) {
    for (const std::uint32_t vertex : triangle) {
      std::array<double, 3> from{}, in_camera{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        from[axis] =
            model.positions[vertex][axis] - scene.origin[axis] - static_cast<double>(scene.camera.position[axis]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        in_camera[0] += from[axis] * static_cast<double>(scene.camera.right[axis]);
        in_camera[1] += from[axis] * static_cast<double>(scene.camera.down[axis]);
        in_camera[2] += from[axis] * static_cast<double>(scene.camera.forward[axis]);
      }
      corners.push_back(
          {static_cast<float>(in_camera[0]), static_cast<float>(in_camera[1]), static_cast<float>(in_camera[2])});
    }
  }
  return corners;
}

/// Corners that were rounded on the screen, put back into space: where they are in the central view, at the depth at
/// which they have their disparity.
Corners rounded_corners(const ScreenTriangles& triangles, const ModelScene& scene) {
  const DepthMapping::Point near = scene.mapping.points.front(), far = scene.mapping.points.back();
  const double b = static_cast<double>(far.parallax_px - near.parallax_px) / (1. / far.depth - 1. / near.depth);
  const double a = static_cast<double>(near.parallax_px) - b / static_cast<double>(near.depth);
  Corners corners;
  for (const ScreenTriangle& triangle : triangles.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double depth = b / (-static_cast<double>(triangle.disparity[k]) - a);
      const double scale = depth / static_cast<double>(scene.camera.focal_px);
      corners.push_back({static_cast<float>(scale * static_cast<double>(triangle.x[k] - scene.camera.centre_x_px)),
                         static_cast<float>(scale * static_cast<double>(triangle.y[k] - scene.camera.centre_y_px)),
                         static_cast<float>(depth)});
    }
  }
  return corners;
}

TriangleBand drawn(const ScreenTriangles& triangles, double view) {
  TriangleBand band(width, 4);
  band.begin(0, height);
  for (std::size_t t = 0; t < triangles.triangles.size(); ++t)
    band.add(triangles.triangles[t], static_cast<std::uint32_t>(t), false);
  band.show(static_cast<float>(view));
  return band;
}

/// Share of the samples of some views where the renderer shows another depth than a ray meets, by more than 1 % of the
/// scene's, or something where there is nothing.
double share_of_other_samples(const Model& model, const ModelScene& scene, bool rounded) {
  const Rig rig = evenly_spaced(width, height, 3, 2);
  const ScreenTriangles triangles = screen_triangles(model, scene, DepthKnots(scene.mapping, scene.camera), rig);
  const Rays rays(rounded ? rounded_corners(triangles, scene) : own_corners(model, scene), scene);
  const float deep = scene.mapping.points.back().depth - scene.mapping.points.front().depth;
  const std::vector<ScreenTriangle>& all = triangles.triangles;
  std::size_t samples = 0, others = 0;
  for (const ViewPosition position : rig.positions) {
    const auto view = static_cast<double>(position.eye_separations());
    const TriangleBand band = drawn(triangles, view);
    for (int row = 0; row < height; ++row) {
      for (int k = 0; k < 4; ++k) {
        const auto line = band.line(row, k);
        for (int column = 0; column < width; ++column) {
          ++samples;
          const double x = column + static_cast<double>(sample_columns(4)[static_cast<std::size_t>(k)]),
                       y = row + (k + 0.5) / 4;
          const float depth = rays.depth(x, y, view);
          if (line[static_cast<std::size_t>(column)] == TriangleBand::nothing) {
            others += std::isinf(depth) ? 0 : 1;
            continue;
          }
          const ScreenTriangle& shown = all[line[static_cast<std::size_t>(column)]];
          const auto [least, most] = std::ranges::minmax(shown.depth);
          const float margin = 0.01f * deep;
          others += depth >= least - margin && depth <= most + margin ? 0 : 1;
        }
      }
    }
  }
  return static_cast<double>(others) / static_cast<double>(samples);
}

TEST(ModelRays, SamplesShowWhatRaysMeet) {
  const auto models = {std::pair{"knot", make_knot(20'000)},
                       {"city", make_city(5000)},
                       {"sphere", make_textured_sphere(5000)},
                       {"tree", make_tree(50'000)}};
  for (const auto& [name, model] : models) {
    const ModelScene scene = scene_around(model, width, height);
    const double rounded = share_of_other_samples(model, scene, true),
                 own = share_of_other_samples(model, scene, false);
    RecordProperty(std::string(name) + "_percent", std::to_string(100 * rounded));
    RecordProperty(std::string(name) + "_not_rounded_percent", std::to_string(100 * own));
    EXPECT_LE(rounded, 1e-4) << name;
    EXPECT_LE(own, 1e-3) << name;
  }
}

TEST(ModelRays, DisparityIsTheProjectionOfThePoint) {
  const Rig rig = evenly_spaced(width, height, 3, 2);
  std::size_t compared = 0;
  float worst = 0;
  for (const Model& model : {make_city(3000), make_knot(3000)}) {
    const ModelScene scene = scene_around(model, width, height);
    const RenderedModel rendered = render_model(model, scene, rig, {.geometry = true});
    const Rays rays(own_corners(model, scene), scene);
    const ScreenTriangles triangles = screen_triangles(model, scene, DepthKnots(scene.mapping, scene.camera), rig);
    for (std::size_t v = 0; v < rig.positions.size(); ++v) {
      const auto view = static_cast<double>(rig.positions[v].eye_separations());
      const TriangleBand band = drawn(triangles, view);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          // Where a pixel's samples lie on several triangles, none of them has the pixel's middle for sure.
          const auto at = static_cast<std::size_t>(x);
          const std::uint32_t shown = band.line(y, 0)[at];
          bool is_whole = shown != TriangleBand::nothing;
          for (int k = 1; k < 4; ++k) is_whole = is_whole && band.line(y, k)[at] == shown;
          if (!is_whole) continue;
          ++compared;
          const float truth = -parallax_px(scene.mapping, rays.depth(x + 0.5, y + 0.5, view));
          worst = std::max(worst, std::abs(rendered.disparity[v](x, y) - truth));
        }
      }
    }
  }
  RecordProperty("compared", static_cast<int>(compared));
  RecordProperty("worst_px", std::to_string(worst));
  EXPECT_GT(compared, 5000u);
  EXPECT_LE(worst, 1.f / 128);
}

}  // namespace wheatstone::model_rays_test
