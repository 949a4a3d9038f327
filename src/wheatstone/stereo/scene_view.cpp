#include "wheatstone/stereo/scene_view.h"

namespace wheatstone {

std::vector<SceneView> scene_from_left(const StereoPairView& pair, const StereoGeometryView& geometry) {
  return {{pair.left, geometry.left_disparity, {}, left_eye},
          {pair.right, geometry.right_disparity, geometry.right_occlusion, right_eye}};
}

std::vector<SceneView> scene_from_centre(const CentralView& centre, const StereoPairView& pair,
                                         const StereoGeometryView& geometry) {
  return {{centre.picture, centre.disparity, {}, central_view},
          {pair.left, geometry.left_disparity, centre.left_only, left_eye},
          {pair.right, geometry.right_disparity, centre.right_only, right_eye}};
}

}  // namespace wheatstone
