#pragma once

#include <algorithm>

#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone {

/// The part of a plane of so many pixels in which something lies; `at(x, y)` is a pixel of the plane. Its upper left
/// pixel is counted from that of the plane. Without pixels where the plane is empty.
template <class At>
Slice cropped_slice(int width, int height, const At& at) {
  int first_x = width, end_x = 0, first_y = height, end_y = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (at(x, y) == LinearRgba{}) continue;
      first_x = std::min(first_x, x);
      end_x = std::max(end_x, x + 1);
      first_y = std::min(first_y, y);
      end_y = y + 1;
    }
  Slice slice{.left = first_x, .top = first_y, .pixels = {}};
  if (end_x <= first_x) return slice;
  slice.pixels = Image<LinearRgba>(end_x - first_x, end_y - first_y);
  for (int y = first_y; y < end_y; ++y)
    for (int x = first_x; x < end_x; ++x) slice.pixels(x - first_x, y - first_y) = at(x, y);
  return slice;
}

}  // namespace wheatstone
