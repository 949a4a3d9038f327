#pragma once

namespace wheatstone {

/// A viewer in front of a display, in millimetres.
struct ViewingGeometry {
  float eye_separation_mm =
      65;  ///< E; for a multiview display, the width of its viewing window (Hassaine 2010, sec. 4.3.2)
  float viewing_distance_mm = 700;  ///< Z
  float screen_width_mm = 376;      ///< W
  int width_px = 640;               ///< of one view across the whole screen
  float pixel_pitch_mm() const { return screen_width_mm / static_cast<float>(width_px); }  ///< i
};

}  // namespace wheatstone
