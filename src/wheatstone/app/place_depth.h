#pragma once

#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// Where a viewer is to see the parts of a scene.
struct DepthPlacing {
  std::vector<DepthRegion> regions;  ///< none: where the photographs have them
  ViewingGeometry viewing;           ///< its width in pixels is that of the painting
};

/// A painting's farthest and nearest disparities, but for outliers: of its surfaces, or where it has none of its marks.
DepthEnds depth_ends_of(const Painting& painting);

/// The painting with its disparities changed so that its places seem where `placing` has them when `width_px` of its
/// pixels fill the screen's width, and disparity 0 lies on the screen; unchanged without regions. Throws
/// Error{wrong_usage} where a place is behind the viewer.
Painting place_depth(Painting painting, const DepthPlacing& placing, int width_px);

}  // namespace wheatstone
