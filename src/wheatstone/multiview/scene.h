#pragma once

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_mapping.h"
#include "wheatstone/multiview/shine.h"
#include "wheatstone/particles/appearance.h"

namespace wheatstone {

/// All that turns particles into splats of the reference view, whatever the number of views.
struct Scene {
  Camera camera;         ///< of the central view
  DepthMapping mapping;  ///< depth to screen parallax
  SplatStyle splat_style;
  Shine shine;  ///< of particles that add their light
};

}  // namespace wheatstone
