#pragma once

#include <cmath>

#include "wheatstone/depth/camera.h"
#include "wheatstone/models/model.h"
#include "wheatstone/multiview/model_scene.h"

namespace wheatstone::bench {

/// A model that fills most of views of so many pixels, with 40 pixels of parallax from its nearest point to its
/// farthest.
inline ModelScene scene_around(const Model& model, int width, int height) {
  const ModelBounds bounds = bounds_of(model);
  const auto radius = static_cast<float>(bounds.radius());
  ModelScene scene;
  scene.origin = bounds.middle();
  scene.camera = camera_around({0, 0, 0}, radius, width, height, {.zoom = 1.3f});
  const auto& [x, y, z] = scene.camera.position;
  const float distance = std::hypot(x, y, z);
  scene.mapping = {{{distance - radius, -20}, {distance + radius, 20}}};
  return scene;
}

}  // namespace wheatstone::bench
