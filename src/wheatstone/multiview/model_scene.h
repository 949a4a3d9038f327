#pragma once

#include <array>

#include "wheatstone/depth/camera.h"
#include "wheatstone/depth/depth_mapping.h"
#include "wheatstone/image/image.h"
#include "wheatstone/number_range.h"

namespace wheatstone {

/// How a model looks. Its surfaces are opaque and are seen from both sides. They are lit from the central camera, by a
/// lamp at its upper left that is far away, and from all around (Phong 1975).
struct ModelLook {
  Rgb8 background{58, 62, 68};
  int samples = 4;  ///< a pixel: 4 or 8
  /// The strength of highlights, as a multiple of the lamps' light. Only highlights differ between views.
  float shine = 0;
  /// Angle by which an eye separation turns the direction to the eye, in radians.
  float turn = 65.f / 700;
};

/// All that makes views of a model. The camera's coordinates are relative to `origin`, in the model's own.
struct ModelScene {
  std::array<double, 3> origin{};
  Camera camera;  ///< of the central view
  DepthMapping mapping;
  ModelLook look;
};

/// The range of screen parallaxes in pixels, and of view positions in eye separations.
inline constexpr NumberRange model_parallax_range{-4096, 4096};

}  // namespace wheatstone
