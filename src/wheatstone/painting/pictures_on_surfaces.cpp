#include "wheatstone/painting/pictures_on_surfaces.h"

#include <limits>
#include <utility>

#include "wheatstone/painting/present.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/stereo/view_scale.h"

namespace wheatstone {
namespace {

/// What a view of the scene is the first to show.
Surface surface_of(const View& view) {
  Image<float> disparity(view.disparity.width(), view.disparity.height());
  for (int y = 0; y < disparity.height(); ++y)
    for (int x = 0; x < disparity.width(); ++x)
      disparity(x, y) = view.wanted.empty() || view.wanted(x, y) != 0 ? view.disparity(x, y)
                                                                      : std::numeric_limits<float>::quiet_NaN();
  return {view.position, KnownRuns(disparity), view.frame.origin_px, view.continued};
}

}  // namespace

PicturesOnSurfaces pictures_on_surfaces(const Painting& painting) {
  PicturesOnSurfaces scene{painting.surfaces, {}};
  for (const Surface& surface : painting.surfaces.seen) {
    const Placement placement{.width = surface.disparity.width(),
                              .height = surface.disparity.height(),
                              .left = static_cast<double>(surface.left_px)};
    scene.pictures.push_back(
        std::move(present(painting, {.views = {surface.view}, .placement = placement}).views.front()));
  }
  return scene;
}

PicturesOnSurfaces pictures_on_surfaces(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                        ViewRange wanted, std::span<const View> known) {
  PicturesOnSurfaces scene;
  for (const View& view : at_reference_scale(known.empty() ? make_still_scene(photographs, geometry, wanted)
                                                           : make_known_scene(photographs, geometry, known))) {
    scene.surfaces.seen.push_back(surface_of(view));
    scene.pictures.push_back(copy_of(view.colour));
  }
  return scene;
}

}  // namespace wheatstone
