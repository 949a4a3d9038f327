#include "output_mode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

std::vector<OutputMode> all_modes() {
  std::vector<OutputMode> modes{{"left", "Left eye", SingleEye::left}, {"right", "Right eye", SingleEye::right}};
  for (const LayoutTraits& traits : stereo_layouts())
    if (is_packed(traits.layout)) modes.push_back({traits.name, std::string(traits.words), traits.layout});
  for (const AnaglyphKind& kind : anaglyph_kinds())
    modes.push_back({kind.name, fmt::format("Anaglyph {} for {} glasses", kind.name, kind.glasses), &kind});
  modes.push_back({"wiggle", "Views one after the other", Wiggle{}});
  modes.push_back({"page-flip", "Shutter glasses, by the graphics card", PageFlip{}});
  modes.push_back({"quilt", "All views of the display", Quilt{}});
  modes.push_back({"lenticular", "The display's lenses", Lenticular{}});
  return modes;
}

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

template <class Named>
const Named& find_named(std::span<const Named> all, std::string_view name, std::string_view kind) {
  const auto found = std::ranges::find(all, name, &Named::name);
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const Named& each : all) names.push_back(each.name);
  throw Error(ErrorKind::wrong_usage,
              fmt::format("'{}' is no {}, expected one of: {}", name, kind, fmt::join(names, ", ")));
}

}  // namespace

std::span<const OutputMode> output_modes() {
  static const std::vector<OutputMode> modes = all_modes();
  return modes;
}

const OutputMode& find_output_mode(std::string_view name) { return find_named(output_modes(), name, "output mode"); }

bool shows_display_views(const OutputMode& mode) {
  return std::holds_alternative<Quilt>(mode.kind) || std::holds_alternative<Lenticular>(mode.kind);
}

std::optional<StereoLayout> interlaced_layout(const OutputMode& mode) {
  const auto* const layout = std::get_if<StereoLayout>(&mode.kind);
  if (layout == nullptr) return {};
  switch (traits_of(*layout).arrangement) {
    case Arrangement::rows:
    case Arrangement::columns:
    case Arrangement::checkerboard:
      return *layout;
    default:
      return {};
  }
}

StereoLayout layout_from(StereoLayout layout, int x, int y) {
  const auto odd = [](int value) { return (static_cast<unsigned>(value) & 1U) != 0; };
  bool changed = false;
  switch (traits_of(layout).arrangement) {
    case Arrangement::rows:
      changed = odd(y);
      break;
    case Arrangement::columns:
      changed = odd(x);
      break;
    case Arrangement::checkerboard:
      changed = odd(x) != odd(y);
      break;
    default:
      break;
  }
  return changed ? with_eyes_swapped(layout) : layout;
}

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

std::span<const LookingWith> devices() {
  static constexpr std::array known{LookingWith{"no-glasses", "No glasses", "left", ""},
                                    LookingWith{"red-cyan", "Red-cyan glasses", "red-cyan", ""},
                                    LookingWith{"3d-screen", "3D screen or projector", "left-right-half", ""},
                                    LookingWith{"looking-glass", "Looking Glass", "quilt", "looking-glass-portrait"},
                                    LookingWith{"headset", "Headset", "left-right", ""}};
  return known;
}

const LookingWith& find_device(std::string_view name) { return find_named(devices(), name, "viewing device"); }

}  // namespace wheatstone::viewer
