#include "wheatstone/painting/still_scene.h"

#include "wheatstone/depth/convergence.h"

namespace wheatstone {

std::vector<OuterView> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                        ViewRange wanted, float zero_parallax_px) {
  std::vector<OuterView> outer;
  std::vector<float> shares{1};
  // What a view halfway uncovers, the outermost one may hide again. Large pictures would take too much memory.
  constexpr double large_px = 8e6;
  if (static_cast<double>(photographs.left.width()) * photographs.left.height() <= large_px) shares.push_back(0.5f);
  for (const float share : shares) {
    for (const ViewPosition outermost : {wanted.first, wanted.last}) {
      const ViewPosition view(share * outermost.eye_separations());
      if (view < left_eye || view > right_eye)
        outer.push_back(make_outer_view(photographs, geometry, view, zero_parallax_px));
    }
  }
  return outer;
}

void append_views(std::span<const OuterView> outer, std::vector<SceneView>& scene) {
  for (const OuterView& view : outer)
    scene.push_back({view.picture, view.disparity, view.uncovered, view.position, view.left_px, true});
}

StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted) {
  StillScene scene;
  scene.views = scene_from_left(photographs, geometry);
  scene.outer = make_outer_views(photographs, geometry, wanted, depth_ends(geometry.left_disparity).middle_px());
  append_views(scene.outer, scene.views);
  return scene;
}

}  // namespace wheatstone
