#pragma once

#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// The painting with other disparities. Marks and surfaces stay where the reference view, that of the first surface,
/// or the left eye where there is none, sees them; what another view was planned for moves along its rows, to where the
/// reference view has it: x' = x + (v − v_ref)(d − d'). A mapping that makes all disparities s times as large is the
/// same as eyes s times as far from the reference view.
Painting with_depth(Painting painting, const DisparityMapping& mapping);

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
