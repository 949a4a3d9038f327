#pragma once

namespace wheatstone {

/// A viewer in front of a display, in millimetres.
struct ViewingGeometry {
  /// E; for a multiview display, the width of its viewing window (Hassaine 2010, sec. 4.3.2).
  float eye_separation_mm = 65;
  float viewing_distance_mm = 700;  ///< Z
  float screen_width_mm = 376;      ///< W
  int width_px = 640;               ///< of one view across the whole screen
  float pixel_pitch_mm() const { return screen_width_mm / static_cast<float>(width_px); }  ///< i
};

/// How far behind the screen, in mm, a point of this screen parallax seems to be; negative in front of it, infinite
/// where the eyes would have to diverge. Hassaine 2010, eqs. 2.1.3 and 2.1.4: behind Z·d/(E−d), in front Z·d/(E+d).
float perceived_depth_mm(const ViewingGeometry& viewing, float parallax_mm);

/// The inverse: eqs. 5.3.4 and 5.3.5, E·F/(Z+F) behind and −E·N/(Z−N) in front. `behind_mm` > −Z; infinite gives E.
float screen_parallax_mm(const ViewingGeometry& viewing, float behind_mm);

/// Depth planes that the display can tell apart between `near_mm` in front of the screen and `far_mm` behind it: the
/// range of parallax in pixels (sec. 5.3.2).
float stereoscopic_resolution(const ViewingGeometry& viewing, float near_mm, float far_mm);

/// Angle between the lines of sight at a point `behind_mm` behind the screen less that on the screen, in degrees:
/// positive in front (eqs. 2.1.1, 2.1.2, 2.1.5).
float angular_disparity_deg(const ViewingGeometry& viewing, float behind_mm);

}  // namespace wheatstone
