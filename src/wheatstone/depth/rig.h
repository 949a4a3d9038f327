#pragma once

#include <vector>

namespace wheatstone {

/// Parallel cameras side by side, seen as where each stands: view positions from the left-most to the right-most, in
/// eye separations; the left eye is -0.5, the central view 0, the right eye 0.5. A point of screen parallax p, in
/// pixels, that the central view has at x, the view at v has at x + v·p.
struct Rig {
  int width = 640;  ///< of each view, in pixels
  int height = 360;
  std::vector<float> positions{-0.5f, 0.5f};
};

/// `count` views evenly spaced over `span` eye separations, around the central one. One view is the central one.
Rig evenly_spaced(int width, int height, int count, float span = 1);

}  // namespace wheatstone
