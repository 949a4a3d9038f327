#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How a pair is brought to a screen.
struct ScreenFrame {
  float zero_parallax_px = 0;  ///< disparity that comes to lie on the screen, in pixels of the pair
  int width = 640;             ///< of a view of the screen
  int height = 360;
  int margin_px = 0;  ///< desired on either side, beyond `width`, so that it can be moved into view
};

/// A pair as a screen shows it, and where its pixels lie. Disparity 0 is the screen's plane.
struct FramedPair {
  StereoPair photographs;
  StereoGeometry geometry;
  int margin_px = 0;  ///< that there was room for, either side: pictures are the frame's width and twice this wide
  float scale = 1;    ///< pixels of the frame for one of the pair
};

/// Shifts the pictures against each other by whole pixels, so that the wanted disparity becomes 0 to within half a
/// pixel; takes the part that both show; scales it so that it fills the frame, and crops what is over at the middle.
/// Throws Error{wrong_usage} where the frame is empty or nothing is left to show.
FramedPair framed(const StereoPair& photographs, const StereoGeometry& geometry, const ScreenFrame& frame);

}  // namespace wheatstone
