#pragma once

#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// What of a scene is to fit between the limits, as lengths from the cameras along the line of sight, in scene units.
struct SceneDepths {
  float nearest = 1;        ///< N'
  float farthest = 10;      ///< F', may be infinite
  float zero_parallax = 2;  ///< Z', the virtual display: what is here stands on the screen
};

/// Where the virtual display must stand so that the nearest point seems `near_mm` in front of the screen and the
/// farthest `far_mm` behind it: (d_N + d_F) / (d_N/F' + d_F/N'), with d_N and d_F the parallaxes of the two limits
/// (Jones et al. 2001, as in Hassaine 2010, sec. 5.3.1).
float zero_parallax_depth(const ViewingGeometry& viewing, float near_mm, float far_mm, float nearest, float farthest);

/// A, the distance between the cameras of the left and the right eye, in scene units: the widest at which neither the
/// nearest nor the farthest point passes its limit. On the virtual display a pixel is i' = Z'/`focal_px` wide, and
/// parallaxes there are as those on the screen: S = i'/i, A = S·d_N·N'/(Z'−N') or S·d_F·F'/(F'−Z'), whichever is less
/// (eqs. 5.3.2, 5.3.3). 0 where the scene has no depth.
float camera_separation(const ViewingGeometry& viewing, float near_mm, float far_mm, const SceneDepths& scene,
                        float focal_px);

/// Screen parallax in pixels that such cameras give a point: eq. 5.3.2, A·(z_rel − 1)/(i'·z_rel), z_rel = z/Z'.
float camera_parallax_px(float separation, float zero_parallax, float focal_px, float depth);

/// Eye separations from the first to the last of `views` when each is seen in a window `window_mm` wide, as rigs count
/// them (Hassaine 2010, sec. 4.3.2).
float span_of_windows(float window_mm, float eye_separation_mm, int views);

}  // namespace wheatstone
