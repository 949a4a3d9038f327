#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Widths of black strips, as put_floating_window takes them.
struct FloatingWindow {
  int left_px = 0;   ///< at the left edge of the left eye's picture
  int right_px = 0;  ///< at the right edge of the right eye's picture
  friend bool operator==(const FloatingWindow&, const FloatingWindow&) = default;
};

/// The narrowest strips with which the frame cuts nothing before the screen for one eye only. Disparity 0 is the
/// screen: what lies before it (disparity above 0) at the left edge of the right eye's picture lies further to the
/// right in the left eye's, which therefore shows more of it; the left strip covers what the right eye does not see of
/// it. The right strip does the same of the right eye's picture. `specks` is the share of the rows, at either side,
/// that may need more.
FloatingWindow floating_window_for(const StereoGeometryView& geometry, double specks = 0.01);

}  // namespace wheatstone
