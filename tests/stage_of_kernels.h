#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/particles/cloud.h"
#include "wheatstone/random.h"

namespace wheatstone {

inline float random(std::uint64_t i, std::uint64_t which) { return unit_float(hash_keys({i, which})); }

/// Particles of unlike masses, in knots and between them, whose kernels are from nearly nothing to a fifth of the scene
/// wide. All lie within the unit ball.
inline Cloud kernels(std::size_t count) {
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const float away = 0.7f * std::pow(random(i, 0), 2.f);
    const float azimuth = 6.2831853f * random(i, 1);
    const float height = 2 * random(i, 2) - 1;
    cloud.x.push_back(away * std::cos(azimuth));
    cloud.y.push_back(away * std::sin(azimuth));
    cloud.z.push_back(away * height);
    cloud.mass.push_back(0.5f + random(i, 3));
    cloud.smoothing_length.push_back(0.002f + 0.2f * away);
    cloud.temperature.push_back(1e4f * (1 + 100 * random(i, 4)));
    cloud.density.push_back(1 / (0.01f + away));
  }
  return cloud;
}

struct Stage {
  CloudStatistics statistics;
  Scene scene;
  Rig rig;
};

/// An orthographic view of the ball of radius 1.2 around 0, so that no kernel leaves the picture.
inline Stage stage_of(const Cloud& cloud, int width, int height, int views = 1, const Appearance& appearance = {}) {
  Stage stage;
  stage.statistics.add(cloud);
  stage.statistics.framed = FramedRegion{.lower = {-1, -1, -1}, .upper = {1, 1, 1}, .sphere_radius = 1.2f};
  stage.rig = evenly_spaced(width, height, views);
  stage.scene.camera = camera_around({0, 0, 0}, 1.2f, width, height, {.orthographic = true});
  const float depth = stage.scene.camera.orthographic_depth;
  stage.scene.mapping.points = {{depth - 1.2f, -15}, {depth + 1.2f, 15}};
  stage.scene.splat_style = make_splat_style(appearance, stage.statistics);
  stage.scene.splat_style.size_depth = depth;
  return stage;
}

}  // namespace wheatstone
