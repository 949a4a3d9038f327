#pragma once

#include "content.h"
#include "view_state.h"
#include "wheatstone/marks/mapped_depth.h"

namespace wheatstone::viewer {

/// Where the state's display shows the parts of a scene.
DepthPlacing placing_of(const ViewState& state);

/// What is shown of what is open: a painting or slices whose depth is placed as the state has it; everything else as it
/// is. Particles are placed as they are rendered, and the views of a display as they are drawn.
Content placed_content(const Content& content, const ViewState& state);

/// Such content with more depth where somebody looks, as the state has it; everything that cannot bend as it is, and
/// likewise for the views of a display.
Content bent_content(const Content& content, const ViewState& state);

/// The depth of a painting of strokes or lines may be another at each place. A region is one flat piece.
bool can_bend(const Content& content);

}  // namespace wheatstone::viewer
