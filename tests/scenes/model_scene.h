#pragma once

#include <algorithm>
#include <cmath>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_mapping.h"
#include "wheatstone/models/model.h"
#include "wheatstone/multiview/model_scene.h"

namespace wheatstone {

/// A scene that shows a model whole, 40 pixels of parallax deep.
inline ModelScene scene_around(const Model& model, int width, int height, const Framing& framing = {}) {
  const ModelBounds bounds = bounds_of(model);
  const auto radius = static_cast<float>(bounds.radius());
  ModelScene scene;
  scene.origin = bounds.middle();
  scene.camera = camera_around({0, 0, 0}, radius, width, height, framing);
  const auto& position = scene.camera.position;
  const float distance = std::hypot(position[0], position[1], position[2]);
  scene.mapping = {{{std::max(distance - radius, distance * 0.01f), -20}, {distance + radius, 20}}};
  return scene;
}

}  // namespace wheatstone
