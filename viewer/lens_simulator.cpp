#include "lens_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/rig.h"

namespace wheatstone::viewer {
namespace {

/// The views of the state's display, from left to right.
std::vector<ViewPosition> display_views(const ViewState& state) {
  const DisplayPreset& display = find_display(state.display);
  return evenly_spaced(0, 0, display.views, std::max(span_of(display), 1.f)).positions;
}

std::size_t nearest(const std::vector<ViewPosition>& views, ViewPosition eye) {
  return static_cast<std::size_t>(
      std::ranges::min_element(views, {}, [eye](ViewPosition view) { return std::abs(view - eye); }) - views.begin());
}

EyePositions positions_between_lenses(const ViewState& state) {
  const float half = state.adjustment.separation / 2;
  return {ViewPosition(state.head - half), ViewPosition(state.head + half)};
}

/// The views on both sides; at the display's ends there is one.
std::vector<LeakingView> neighbours(const std::vector<ViewPosition>& views, std::size_t at, float share) {
  std::vector<LeakingView> found;
  if (at > 0) found.push_back({views[at - 1], share / 2});
  if (at + 1 < views.size()) found.push_back({views[at + 1], share / 2});
  return found;
}

}  // namespace

EyePositions eye_positions(const ViewState& state) {
  const EyePositions eyes = positions_between_lenses(state);
  if (!state.quantised) return eyes;
  const std::vector<ViewPosition> views = display_views(state);
  return {views[nearest(views, eyes.left)], views[nearest(views, eyes.right)]};
}

Leaks leaks_of(const ViewState& state) {
  if (state.crosstalk <= 0) return {};
  const EyePositions eyes = eye_positions(state);
  const std::vector<ViewPosition> views = display_views(state);
  if (!state.quantised || views.size() <= 2) return {{{eyes.right, state.crosstalk}}, {{eyes.left, state.crosstalk}}};
  return {neighbours(views, nearest(views, eyes.left), state.crosstalk),
          neighbours(views, nearest(views, eyes.right), state.crosstalk)};
}

std::string seen_views_told(const ViewState& state) {
  if (!state.quantised) return {};
  const EyePositions eyes = positions_between_lenses(state);
  const std::vector<ViewPosition> views = display_views(state);
  return fmt::format("on {} the left eye sees view {} and the right eye view {} of {}", state.display,
                     nearest(views, eyes.left) + 1, nearest(views, eyes.right) + 1, views.size());
}

}  // namespace wheatstone::viewer
