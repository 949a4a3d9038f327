#pragma once

#include <span>
#include <vector>

#include "wheatstone/marks/painting.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

/// A scene as pictures of its surfaces, from which other views can be made without its marks.
struct PicturesOnSurfaces {
  Surfaces surfaces;
  std::vector<Image<Rgb8>> pictures;  ///< of each of `surfaces.seen`, as its view shows it, in its own columns
};

/// A painting; empty where it has no surfaces.
PicturesOnSurfaces pictures_on_surfaces(const Painting& painting);

/// A photograph with its geometry, to be seen from all `wanted` views (make_still_scene); where there are `known`
/// views, with what these show (make_known_scene).
PicturesOnSurfaces pictures_on_surfaces(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                        ViewRange wanted, std::span<const View> known = {});

}  // namespace wheatstone
