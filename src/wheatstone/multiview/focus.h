#pragma once

#include <algorithm>

namespace wheatstone {

/// Where on the screen the depth differs from that elsewhere (Hassaine 2010, sec. 6.3): every parallax is multiplied by
/// `gain` at a point of a view, by 1 from `radius_px` on, and smoothly between.
struct Focus {
  float x_px = 0, y_px = 0;  ///< where the viewer looks, in a view's pixels
  float radius_px = 1;
  float gain = 1;

  float gain_at(float x, float y) const {
    const float dx = x - x_px;
    const float dy = y - y_px;
    const float inside = std::max(1 - (dx * dx + dy * dy) / (radius_px * radius_px), 0.f);
    return 1 + (gain - 1) * inside * inside;
  }
  float largest_gain() const { return std::max(gain, 1.f); }
};

/// Throws Error{wrong_usage} where a focus would fold a view: pixels of a row that are moved by up to
/// `largest_shift_px` must keep their order.
void check_focus(const Focus& focus, float largest_shift_px);

}  // namespace wheatstone
