#include "wheatstone/painting/still_scene.h"

#include "wheatstone/depth/convergence.h"

namespace wheatstone {

StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted) {
  StillScene scene;
  scene.views = scene_from_left(photographs, geometry);
  const float middle_px = depth_ends(geometry.left_disparity).middle_px();
  std::vector<float> shares{1};
  // What a view halfway uncovers, the outermost one may hide again. Large pictures would take too much memory.
  constexpr double large_px = 8e6;
  if (static_cast<double>(photographs.left.width()) * photographs.left.height() <= large_px) shares.push_back(0.5f);
  for (const float share : shares) {
    for (const ViewPosition outermost : {wanted.first, wanted.last}) {
      const ViewPosition view(share * outermost.eye_separations());
      if (view < left_eye || view > right_eye)
        scene.outer.push_back(make_outer_view(photographs, geometry, view, middle_px));
    }
  }
  for (const OuterView& view : scene.outer)
    scene.views.push_back({view.picture, view.disparity, view.uncovered, view.position});
  return scene;
}

}  // namespace wheatstone
