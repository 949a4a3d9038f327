#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "comfort.h"
#include "command_groups_internal.h"
#include "depth_placing.h"
#include "layers_apart.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

void set_panel(Viewer& viewer, const Words& words) {
  static constexpr std::array names{std::pair{std::string_view("off"), Panel::off},
                                    std::pair{std::string_view("style"), Panel::style},
                                    std::pair{std::string_view("depth"), Panel::depth}};
  for (const auto& [name, panel] : names)
    if (name == words[0]) {
      viewer.session().panel = panel;
      return;
    }
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no panel, expected style, depth or off", words[0]));
}

void toggle(Viewer& viewer, Panel panel) {
  Panel& shown = viewer.session().panel;
  shown = shown == panel ? Panel::off : panel;
}

void set_regions(Viewer& viewer, std::vector<DepthRegion> regions) {
  viewer.session().zero_parallax_target_px.reset();
  state_of(viewer).depth_regions = std::move(regions);
  viewer.show_comfortably();
}

void map_depth(Viewer& viewer, const Words& words) {
  const ViewingGeometry viewing = viewing_of(find_display(state_of(viewer).display));
  if (words[0] == "reset") return set_regions(viewer, {});
  if (words[0] == "comfortable") {
    const ComfortableDepth depth = comfortable_depth(viewing);
    return set_regions(viewer, {{0, -depth.near_mm}, {1, depth.far_mm}});
  }
  std::vector<DepthRegion> regions = parse_depth_regions(words[0], "the mapping");
  for (const DepthRegion& region : regions)
    if (!(region.behind_mm > -viewing.viewing_distance_mm))
      throw Error(ErrorKind::wrong_usage, fmt::format("{:.0f} mm is behind the viewer, who is {:.0f} mm away",
                                                      region.behind_mm, viewing.viewing_distance_mm));
  set_regions(viewer, std::move(regions));
}

void set_layers_apart(Viewer& viewer, const Words& words) {
  constexpr double steepest_deg = 80;
  state_of(viewer).layers_apart_deg =
      words[0] == "off" ? 0 : static_cast<float>(number_of(words[0], -steepest_deg, steepest_deg));
}

constexpr float usual_angle_deg = 40;

constexpr Command panel_table[] = {
    // name, arguments, menu, text, keys
    {"panel", "style|depth|off", "View", "Panel beside the picture", "", set_panel},
    {"style-panel", "", "Painting", "Style panel", "S", [](Viewer& v, const Words&) { toggle(v, Panel::style); }},
    {"depth-panel", "", "Depth", "Depth panel", "D", [](Viewer& v, const Words&) { toggle(v, Panel::depth); }},
    {"depth-mapping", "SHARE:MM,...|comfortable|reset", "Depth",
     "Depths behind the screen of parts of the scene, from 0, the nearest, to 1", "", map_depth},
    {"comfort", "", "Depth", "Tell whether the depth is comfortable", "",
     [](Viewer& v, const Words&) { v.tell(comfort_told(v)); }},
    {"crosstalk", "PERCENT", "Depth", "Crosstalk: light of the neighbouring views in each eye, in %", "",
     [](Viewer& v, const Words& w) { state_of(v).crosstalk = static_cast<float>(number_of(w[0], 0, 50) / 100); }},
    {"layers-apart", "ANGLE|off", "Painting", "Look at the layers of strokes from a side, in degrees", "",
     set_layers_apart},
    {"side-view", "", "Painting", "Layers from the side", "A",
     [](Viewer& v, const Words&) {
       float& angle = state_of(v).layers_apart_deg;
       angle = angle == 0 ? usual_angle_deg : 0;
     }},
};

}  // namespace

std::span<const Command> panel_commands() { return panel_table; }

}  // namespace wheatstone::viewer
