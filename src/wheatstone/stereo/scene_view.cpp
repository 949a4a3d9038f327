#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {
namespace {

constexpr float left_position = -0.5f, right_position = 0.5f;

}  // namespace

std::vector<SceneView> scene_from_left(const StereoPair& pair, const StereoGeometry& geometry) {
  return {{pair.left, geometry.left_disparity, {}, left_position},
          {pair.right, geometry.right_disparity, geometry.right_occlusion, right_position}};
}

std::vector<SceneView> scene_from_centre(const CentralView& centre, const StereoPair& pair,
                                         const StereoGeometry& geometry) {
  return {{centre.picture, centre.disparity, {}, 0},
          {pair.left, geometry.left_disparity, centre.left_only, left_position},
          {pair.right, geometry.right_disparity, centre.right_only, right_position}};
}

}  // namespace wheatstone
