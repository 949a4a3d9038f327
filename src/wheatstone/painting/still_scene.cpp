#include "wheatstone/painting/still_scene.h"

#include "wheatstone/depth/convergence.h"

namespace wheatstone {

StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted) {
  StillScene scene;
  scene.views = scene_from_left(photographs, geometry);
  const float middle_px = depth_ends(geometry.left_disparity).middle_px();
  if (wanted.first < left_eye) scene.outer.push_back(make_outer_view(photographs, geometry, wanted.first, middle_px));
  if (wanted != ViewRange{}) scene.outer.push_back(make_outer_view(photographs, geometry, central_view, middle_px));
  if (wanted.last > right_eye) scene.outer.push_back(make_outer_view(photographs, geometry, wanted.last, middle_px));
  for (const OuterView& view : scene.outer)
    scene.views.push_back({view.picture, view.disparity, view.uncovered, view.position});
  return scene;
}

}  // namespace wheatstone
