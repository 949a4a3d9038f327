#pragma once

#include <cmath>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/known_runs.h"

namespace wheatstone {

/// Steps of a surface's disparities for one pixel: what a painting file keeps.
inline constexpr float disparity_steps = 16;

/// The nearest disparity that a surface keeps.
inline float in_whole_steps(float disparity_px) { return std::round(disparity_px * disparity_steps) / disparity_steps; }

/// What one view sees of the scene's surfaces, as far as it is the first to tell: disparity in pixels, in whole
/// steps; NaN where another surface tells.
struct Surface {
  ViewPosition view;
  KnownRuns disparity;
  int left_px = 0;         ///< column of the painting's pictures at which its first one stands
  bool continued = false;  ///< no photograph shows it: it lies behind whatever a photograph tells
  friend bool operator==(const Surface&, const Surface&) = default;
};

/// The surfaces that a painting's marks lie on, the reference view's first: what it sees, what only other views see,
/// and what no photograph shows and a wider view uncovers. A mark is hidden from a view where one of them lies before
/// it.
struct Surfaces {
  std::vector<Surface> seen;
  float tolerance_px = 2;  ///< of disparity, by which a surface must lie before a mark to hide it
  friend bool operator==(const Surfaces&, const Surfaces&) = default;
};

/// From the leftmost to the rightmost view whose surface a photograph shows.
ViewRange photographed_views(const Surfaces& surfaces);

/// The views in which surfaces are known: from the leftmost to the rightmost of them.
ViewRange known_views(const Surfaces& surfaces);

}  // namespace wheatstone
