#pragma once

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How the two eyes' pictures become one.
enum class CentralMerge {
  visible,  ///< both eyes where both see a point and agree on its colour, else the one that sees it
  average   ///< half of each everywhere (Bukenberger et al. 2015, eq. 2): ghosts where only one eye sees
};

/// A pair as the eye between its two eyes sees it: the view at `central_view`.
struct CentralView {
  Image<Rgb8> picture;     ///< M
  Image<float> disparity;  ///< D⁻¹ (eq. 4), at full eye separation; all finite
  Image<std::uint8_t> left_only,
      right_only;  ///< of each eye's own pixels, 255 where the central view hides their point
};

/// Merges a pair: each eye's picture is mapped forward by half its disparity, nearest wins, interpolated by Lanczos
/// along the scan line; pixels to which neither eye maps get the smaller disparity of their neighbours and the colour
/// there (Bukenberger et al. 2015, sec. 2.2). The geometry has no unknown disparities. Throws Error{bad_input} where it
/// does not fit the pair.
CentralView make_central_view(const StereoPairView& pair, const StereoGeometryView& geometry,
                              CentralMerge merge = CentralMerge::visible);

}  // namespace wheatstone
