#pragma once

#include <vector>

#include "wheatstone/depth/view_position.h"

namespace wheatstone {

/// Parallel cameras side by side: their view positions from the left-most to the right-most. A point of screen parallax
/// p, in pixels, that the central view has at x, the view at v has at x + v·p.
struct Rig {
  int width = 640;  ///< of each view, in pixels
  int height = 360;
  std::vector<ViewPosition> positions{left_eye, right_eye};
};

/// `count` views evenly spaced over `span` eye separations, around the central one. One view is the central one.
Rig evenly_spaced(int width, int height, int count, float span = 1);

}  // namespace wheatstone
