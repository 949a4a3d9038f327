#pragma once

#include <vector>

#include "wheatstone/marks/view_range.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {

/// A pair as the scene that its painting is planned from: the left eye as the reference view, what only the right eye
/// sees, and what no photograph shows and views beside the eyes uncover.
struct StillScene {
  std::vector<OuterView> outer;
  std::vector<SceneView> views;  ///< refer to `outer` and to the photographs
};

/// A scene that can be seen from all `wanted` views.
StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted);

}  // namespace wheatstone
