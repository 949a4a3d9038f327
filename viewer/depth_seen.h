#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content.h"
#include "view_state.h"
#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/marks/mapped_depth.h"

namespace wheatstone::viewer {

class Viewer;

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

/// The whole scene's depth as the chosen display's viewer sees it now.
struct DepthSeen {
  float near_mm = 0, far_mm = 0;         ///< in front of the screen, and behind it; an end may be on the other side
  float total_percent = 0;               ///< parallax of both ends together, of the screen's width
  std::vector<std::string> discomforts;  ///< one sentence each; none: it is comfortable
};

/// None where the depth is not known, or nothing has been drawn.
std::optional<DepthSeen> depth_seen(const Viewer& viewer);

/// The depths in front of the screen and behind it up to which a viewer is comfortable, by `discomforts`.
struct ComfortableDepth {
  float near_mm = 0, far_mm = 0;
};
ComfortableDepth comfortable_depth(const ViewingGeometry& viewing);

/// Both as one line for people, with the numbers and the display's name.
std::string comfort_told(const Viewer& viewer);

/// The numbers of the whole scene, as a status bar has room for; empty where they are not known.
std::string comfort_in_short(const Viewer& viewer);

/// What lies at a pixel of the frame: its disparity, and how far in front of the screen or behind it it seems; empty
/// where that is not known.
std::string depth_told(const Viewer& viewer, double x, double y);

}  // namespace wheatstone::viewer
