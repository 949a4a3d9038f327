#pragma once

#include <vector>

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/regions/region_map_internal.h"

namespace wheatstone {

struct OutlineOptions {
  int smoothing = 2;          ///< rounds of averaging that take the pixels' steps away
  float tolerance_px = 0.7f;  ///< by which a polygon may leave the smoothed outline
  float longest_px = 24;      ///< sides are no longer than this, so that they follow curved surfaces
  float depth_threshold_px = 2;
};

/// The rings of every region as a mark (for all views; its colour is not yet set), in the order of their numbers, added
/// to a painting. Neighbours share the points between them; where they lie on one surface they share the disparities
/// too, so that they part in no view. A region so narrow that fewer than three points are left of it gets a mark
/// without rings.
void add_outlines(const RegionMap& regions, ImageView<const float> disparity, ViewPosition view,
                  const OutlineOptions& options, RegionPainting& painting);

}  // namespace wheatstone
