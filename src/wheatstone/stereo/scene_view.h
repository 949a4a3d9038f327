#pragma once

#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// One view of a scene, whole or the part that the reference view does not show. Borrows its images, which are of one
/// size; `only_here` may be empty. What no eye sees may be in smaller pictures than the reference view's.
struct SceneView {
  ImageView<const Rgb8> picture;
  ImageView<const float> disparity;         ///< in its pictures' pixels; no unknowns
  ImageView<const std::uint8_t> only_here;  ///< 255 for what the reference view does not show; empty: all is wanted
  ViewPosition position = central_view;
  int left_px = 0;         ///< column of the eyes' pictures at which the view's begin
  bool continued = false;  ///< no eye sees what is wanted of it: it lies behind whatever an eye sees
  int reduction = 1;       ///< so many pixels of the reference view's picture become one; a rest is left out
};

/// The left eye as reference view, and what only the right one sees.
std::vector<SceneView> scene_from_left(const StereoPairView& pair, const StereoGeometryView& geometry);

/// The central view as reference, and what only the left and only the right eye sees.
std::vector<SceneView> scene_from_centre(const CentralView& centre, const StereoPairView& pair,
                                         const StereoGeometryView& geometry);

}  // namespace wheatstone
