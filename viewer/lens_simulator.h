#pragma once

#include <string>
#include <vector>

#include "view_state.h"
#include "wheatstone/depth/view_position.h"

namespace wheatstone::viewer {

/// The positions from which a state's two eyes look: with the lens simulator those of the display's views.
struct EyePositions {
  ViewPosition left, right;
};
EyePositions eye_positions(const ViewState& state);

/// What of a neighbouring view an eye sees as well.
struct LeakingView {
  ViewPosition view;
  float share = 0;
};

/// What crosstalk lets through to the left eye and to the right one: half of it of each of the neighbours of the
/// display's view that the lens simulator shows, else the other eye's view. Nothing without crosstalk.
struct Leaks {
  std::vector<LeakingView> left, right;
};
Leaks leaks_of(const ViewState& state);

/// Which of the display's views each eye sees, as one line; empty without the lens simulator.
std::string seen_views_told(const ViewState& state);

}  // namespace wheatstone::viewer
