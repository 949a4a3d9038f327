#pragma once

#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/number_range.h"

namespace wheatstone {

/// What callers may ask of views: how many, how many eye separations from the first to the last, and pixels a side.
inline constexpr NumberRange view_count_range{1, 1000}, view_span_range{0, 100}, view_side_range{1, 16384};

/// Parallel cameras side by side: their view positions from the left-most to the right-most. A point of screen parallax
/// p, in pixels, that the central view has at x, the view at v has at x + v·p.
struct Rig {
  int width = 640;  ///< of each view, in pixels
  int height = 360;
  std::vector<ViewPosition> positions{left_eye, right_eye};
};

/// `count` views evenly spaced over `span` eye separations, around the central one. One view is the central one. Throws
/// Error{wrong_usage} where there are not 1 to 1000, or the span is out of its range.
Rig evenly_spaced(int width, int height, int count, float span = 1);

/// Throws Error{wrong_usage} where a side of a view is out of its range, or the views of the rig, of three bytes a
/// pixel, together take more than this computer's memory.
void check_views_fit(const Rig& rig);

}  // namespace wheatstone
