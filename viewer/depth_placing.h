#pragma once

#include "content.h"
#include "view_state.h"
#include "wheatstone/app/place_depth.h"

namespace wheatstone::viewer {

/// Where the state's display shows the parts of a scene.
DepthPlacing placing_of(const ViewState& state);

/// What is shown of what is open: a painting or slices whose depth is placed as the state has it; everything else as it
/// is. Particles are placed as they are rendered, and the views of a display as they are drawn.
Content placed_content(const Content& content, const ViewState& state);

}  // namespace wheatstone::viewer
