#pragma once

#include "wheatstone/painting/polygon_mark.h"
#include "wheatstone/painting/style.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A pair as a mosaic of stained glass (Hausner 2001; Bukenberger et al. 2015, sec. 4.2): tiles about `style.tile_px`
/// wide, a centroidal Voronoi diagram under the square metric turned along the picture's edges, which tiles keep clear
/// of. A tile shows the mean colour of what it covers, lies on one surface and is bordered by a darker joint. Both eyes
/// show the tiles of the left one; what only the right eye sees is tiled there. Throws Error: bad_input where the
/// geometry does not fit, wrong_usage for a style that cannot be painted with.
PolygonPainting plan_mosaic(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style);

}  // namespace wheatstone
