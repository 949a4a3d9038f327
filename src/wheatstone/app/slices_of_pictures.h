#pragma once

#include <optional>

#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/painting/pictures_on_surfaces.h"

namespace wheatstone {

/// A painting, or a photograph, as slices, whose depth is chosen when it is shown (Hassaine 2010, sec. 6.2, content
/// from real life). Each pixel of each surface's picture lies, opaque, in the plane nearest to its disparity; where a
/// surface goes on in the planes behind, its edge lies in these, too, so that no gap opens between them. Planes are a
/// pixel of disparity apart, or farther where that would be more than 64. `zero_parallax_px` is the disparity on the
/// screen plane; none: the middle between nearest and farthest. Throws Error{bad_input} for a painting without
/// surfaces.
SliceStack slices_of(const PicturesOnSurfaces& scene, std::optional<float> zero_parallax_px = {});

}  // namespace wheatstone
