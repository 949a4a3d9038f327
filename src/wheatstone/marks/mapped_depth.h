#pragma once

#include <vector>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The painting with other disparities. Marks and surfaces stay where the reference view, that of the first surface,
/// or the left eye where there is none, sees them; what another view was planned for moves along its rows, to where the
/// reference view has it: x' = x + (v − v_ref)(d − d'). A mapping that makes all disparities s times as large is the
/// same as eyes s times as far from the reference view.
Painting with_depth(Painting painting, const DisparityMapping& mapping);

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

/// More depth around a place than elsewhere (Hassaine 2010, sec. 6.3). A disparity d that the reference view sees at a
/// place becomes d₀ + g·(d − d₀): d₀ is that of the middle, which keeps its depth, and g falls off with the distance
/// from it as a Gaussian does, from `gain_there` to `gain_elsewhere`.
struct DepthAround {
  float x = 0, y = 0;        ///< the middle, in pixels of the reference view
  float disparity_px = 0;    ///< there
  float gain_there = 1;      ///< 0 or more, as the next
  float gain_elsewhere = 1;  ///< far from the middle
  float radius_px = 100;     ///< the Gaussian's standard deviation
  friend bool operator==(const DepthAround&, const DepthAround&) = default;
};

float gain_at(const DepthAround& around, float x, float y);

/// The least radius for scenes of this depth: with it, what is equally near keeps its order on a row in all views up to
/// two eye separations from the reference view, and at one separation is squeezed to no less than half its width.
float least_radius_px(const DepthAround& around, const DepthEnds& ends);

/// The painting with more depth around a place, within at least least_radius_px; otherwise as with_depth. Not for
/// regions: each is one flat piece, however large, and cannot bend.
Painting with_depth_around(Painting painting, const DepthAround& around);

}  // namespace wheatstone
