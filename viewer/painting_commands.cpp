#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "command_table.h"
#include "depth_seen.h"
#include "inputs.h"
#include "layers_apart.h"
#include "screens.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::viewer {
namespace {

int layer_count(const Viewer& viewer) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  return content != nullptr && content->painting ? static_cast<int>(layers_of(*content->painting).size()) : 0;
}

void step_detail(Viewer& viewer, int by) {
  const int finest = layer_count(viewer) - 1;
  if (finest < 0) return;
  int& layer = state_of(viewer).slicing.finest_layer;
  layer = std::clamp(std::min(layer, finest) + by, 0, finest);
}

constexpr float slice_step = 0.02f;  ///< of the way from the nearest stroke to the farthest

void set_slice_depth(Viewer& viewer, const Words& words) {
  state_of(viewer).slicing.depths =
      words[0] == "off" ? std::vector<SliceDepth>() : parse_slice_depths(words[0], "slice-depth");
}

void set_slice_keep(Viewer& viewer, const Words& words) {
  if (words[0] != "back" && words[0] != "front")
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no side of a plane, expected back or front", words[0]));
  state_of(viewer).slicing.keeps = words[0] == "back" ? SliceKeeps::back : SliceKeeps::front;
}

void toggle_slice(Viewer& viewer, const Words& /*words*/) {
  constexpr SliceDepth middle{0.5f};
  std::vector<SliceDepth>& depths = state_of(viewer).slicing.depths;
  depths = depths.empty() ? std::vector{middle} : std::vector<SliceDepth>();
}

/// From where the plane is, counted from that of the finest layer; without one, from the nearest stroke.
void step_slice(Viewer& viewer, float by, std::size_t plane = 0) {
  std::vector<SliceDepth>& depths = state_of(viewer).slicing.depths;
  depths.resize(std::max(depths.size(), plane + 1), {0, true});
  float from = depths[plane].is_share ? depths[plane].value : 0;
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  if (!depths[plane].is_share && content != nullptr && content->painting)
    from = shares_of(depths, *content->painting)[plane];
  depths[plane] = {std::clamp(from + by, 0.f, 1.f), true};
  viewer.tell(fmt::format("slicing plane at {:.0f} % of the way", 100 * depths[plane].value));
}

void set_style(Viewer& viewer, const Words& words) {
  state_of(viewer).style = read_style(words[0]);
  viewer.paint();
}

void set_parameter(Viewer& viewer, const Words& words) {
  const auto parameters = style_parameters();
  const auto found = std::ranges::find(parameters, words[0], &StyleParameter::name);
  if (found == parameters.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no parameter of a style", words[0]));
  Style style = state_of(viewer).style;
  found->set(style, words[1]);
  check_style(style);
  if (style == state_of(viewer).style) return;
  state_of(viewer).style = style;
  viewer.paint();
}

void compare(Viewer& viewer, const Words& words) {
  state_of(viewer).comparison = static_cast<Comparison>(place_among(comparison_names, words[0], "comparison"));
}

std::vector<Choice> style_choices(const Viewer& /*viewer*/) {
  std::vector<Choice> choices;
  for (const std::string_view name : style_names()) choices.push_back({std::string(name), readable(name)});
  return choices;
}

constexpr Command painting_table[] = {
    // name, arguments, menu, text, keys
    {"finest-layer", "NUMBER", "Painting", "Finest layer of strokes that is shown; 0 is the coarsest", "",
     [](Viewer& v, const Words& w) { state_of(v).slicing.finest_layer = static_cast<int>(number_of(w[0], 0, 1000)); }},
    {"slice-depth", "SHARE%|DISPARITYpx,...|off", "Painting",
     "Slicing planes of the finest layer and of those under it: strokes before a layer's plane are hidden", "",
     set_slice_depth},
    {"slice-keep",
     "back|front",
     "Painting",
     "Strokes that stay: behind the plane or before it",
     "",
     set_slice_keep,
     {.now =
          [](const Viewer& v) {
            return v.session().state.slicing.keeps == SliceKeeps::back ? std::string("back") : std::string("front");
          }}},
    {"slice",
     "",
     "Painting",
     "Slice the finest layer, or show it whole",
     "X",
     toggle_slice,
     {.now = [](const Viewer& v) { return on_or_off(!v.session().state.slicing.depths.empty()); },
      .icon = "slice",
      .begins_group = true}},
    {"slice-nearer", "", "Painting", "Move the slicing plane nearer", "{",
     [](Viewer& v, const Words&) { step_slice(v, -slice_step); }},
    {"slice-farther", "", "Painting", "Move the slicing plane farther", "}",
     [](Viewer& v, const Words&) { step_slice(v, slice_step); }},
    {"slice-move",
     "NUMBER BY",
     "Painting",
     "Move the plane of a layer, counted from the finest one, 0, by a share of the way",
     "",
     [](Viewer& v, const Words& w) {
       step_slice(v, static_cast<float>(number_of(w[1], -1, 1)), static_cast<std::size_t>(number_of(w[0], 0, 99)));
     },
     {.is_for_scripts = true}},
    {"less-detail",
     "",
     "Painting",
     "Less detail",
     "[",
     [](Viewer& v, const Words&) { step_detail(v, -1); },
     {.begins_group = true}},
    {"more-detail", "", "Painting", "More detail", "]", [](Viewer& v, const Words&) { step_detail(v, 1); }},
    {"style",
     "NAME|FILE",
     "Painting",
     "Style",
     "",
     set_style,
     {.choices = style_choices, .now = [](const Viewer& v) { return v.session().state.style.name; }}},
    {"set", "PARAMETER VALUE", "Painting", "Change a parameter of the style", "", set_parameter},
    {"compare",
     "painting|photograph|split|depth",
     "Painting",
     "Compare with the photograph, or its depth",
     "",
     compare,
     {.now =
          [](const Viewer& v) {
            return std::string(comparison_names[static_cast<std::size_t>(v.session().state.comparison)]);
          },
      .icon = "compare"}},
    {"undo",
     "",
     "Painting",
     "Undo",
     "Ctrl+Z",
     [](Viewer& v, const Words&) { undo(v); },
     {.applies = [](const Viewer& v) { return !v.session().done.empty(); }, .begins_group = true}},
    {"redo",
     "",
     "Painting",
     "Redo",
     "Ctrl+Shift+Z",
     [](Viewer& v, const Words&) { redo(v); },
     {.applies = [](const Viewer& v) { return !v.session().undone.empty(); }}},
};

void ease_zero_parallax(Viewer& viewer, float disparity_px) {
  viewer.session().zero_parallax_target_px = disparity_px;
  viewer.session().easing_s = click_easing_s;
}

void zero_parallax_at(Viewer& viewer, const Words& words) {
  frame_of(viewer);
  const std::optional<float> disparity = disparity_under(viewer, number_of(words[0]), number_of(words[1]));
  if (!disparity) {
    viewer.tell("the depth is not known there");
    return;
  }
  ease_zero_parallax(viewer, *disparity);
}

void step_zero_parallax(Viewer& viewer, float by_px) {
  Adjustment& adjustment = state_of(viewer).adjustment;
  viewer.session().zero_parallax_target_px.reset();
  adjustment.zero_parallax_px += by_px;
}

/// While a film plays the same keys go on and back in it, as players have it.
void move_head(Viewer& viewer, int steps) {
  constexpr float head_step = 0.1f;
  constexpr double film_step_s = 5;
  if (const auto& film = viewer.session().film; film && film->plays)
    viewer.seek_film(film->seconds + steps * film_step_s);
  else
    state_of(viewer).head += static_cast<float>(steps) * head_step;
}

std::vector<Choice> display_choices(const Viewer& /*viewer*/) {
  std::vector<Choice> choices;
  for (const DisplayPreset& display : display_presets())
    choices.push_back({std::string(display.name), fmt::format("{} ({})", display.name, display.note)});
  return choices;
}

std::vector<Choice> calibration_choices(const Viewer& /*viewer*/) {
  return {{"bridge", "Calibration of Looking Glass Bridge"}};
}

constexpr Command depth_table[] = {
    // name, arguments, menu, text, keys
    {"zero-parallax",
     "DISPARITY",
     "Depth",
     "Disparity on the screen plane: in pixels of the picture",
     "",
     [](Viewer& v, const Words& w) { ease_zero_parallax(v, static_cast<float>(number_of(w[0], -65535, 65535))); },
     {.now =
          [](const Viewer& v) {
            return fmt::format(
                "{}", v.session().zero_parallax_target_px.value_or(v.session().state.adjustment.zero_parallax_px));
          },
      .range = {-100, 100, 1}}},
    {"zero-parallax-at", "X Y", "Depth", "Put the screen plane at the depth of a place in the picture", "",
     zero_parallax_at},
    {"nearer", "", "Depth", "Bring the scene nearer", "Alt+Left, /",
     [](Viewer& v, const Words&) { step_zero_parallax(v, -1); }},
    {"farther", "", "Depth", "Move the scene farther away", "Alt+Right, *",
     [](Viewer& v, const Words&) { step_zero_parallax(v, 1); }},
    {"separation",
     "EYES",
     "Depth",
     "Distance of the eyes: in eye separations of the picture",
     "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.separation = static_cast<float>(number_of(w[0], 0, 10)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.adjustment.separation); },
      .range = {0, 2, 0.05}}},
    {"comfortable", "", "Depth", "Comfortable depth", "Home", [](Viewer& v, const Words&) { v.show_comfortably(); }},
    {"vertical",
     "PIXELS",
     "Depth",
     "Right picture down: in screen pixels",
     "",
     [](Viewer& v, const Words& w) {
       state_of(v).adjustment.vertical_px = static_cast<float>(number_of(w[0], -1000, 1000));
     },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.adjustment.vertical_px); },
      .range = {-50, 50, 1}}},
    {"roll",
     "DEGREES",
     "Depth",
     "Right picture turned: clockwise, in degrees",
     "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.roll_deg = static_cast<float>(number_of(w[0], -45, 45)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.adjustment.roll_deg); },
      .range = {-5, 5, 0.1}}},
    {"head",
     "X",
     "Tracking",
     "Position of the head: in eye separations",
     "",
     [](Viewer& v, const Words& w) { state_of(v).head = static_cast<float>(number_of(w[0], -100, 100)); },
     {.now = [](const Viewer& v) { return fmt::format("{}", v.session().state.head); }, .range = {-1, 1, 0.05}}},
    {"head-left", "", "Tracking", "Move the head to the left", "Left",
     [](Viewer& v, const Words&) { move_head(v, -1); }},
    {"head-right", "", "Tracking", "Move the head to the right", "Right",
     [](Viewer& v, const Words&) { move_head(v, 1); }},
    {"display",
     "NAME",
     "Depth",
     "Display",
     "",
     [](Viewer& v, const Words& w) { state_of(v).display = find_display(w[0]).name; },
     {.choices = display_choices,
      .now = [](const Viewer& v) { return v.session().state.display; },
      .begins_group = true}},
    {"screen",
     "NAME|FILE|bridge",
     "Depth",
     "Lenticular screen, or its calibration, or that of Looking Glass Bridge",
     "",
     [](Viewer& v, const Words& w) {
       if (w[0] == "bridge") return use_screen_of_bridge(v);
       find_lenticular(w[0]);
       state_of(v).screen = w[0];
     },
     {.choices = calibration_choices}},
    {"lens-simulator",
     "on|off",
     "Depth",
     "Lens simulator: what the eyes see through the display's lenses",
     "",
     [](Viewer& v, const Words& w) { state_of(v).quantised = switch_of(w[0]); },
     {.now = [](const Viewer& v) { return on_or_off(v.session().state.quantised); }}},
};

void set_panel(Viewer& viewer, const Words& words) {
  viewer.session().panel = static_cast<Panel>(place_among(panel_names, words[0], "panel"));
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

std::vector<Choice> mapping_choices(const Viewer& /*viewer*/) {
  return {{"comfortable", "All of the comfortable depth"}, {"reset", "As in the photographs"}};
}

constexpr float usual_angle_deg = 40;

constexpr Command panel_table[] = {
    // name, arguments, menu, text, keys
    {"panel",
     "style|depth|particles|off",
     "View",
     "Panel beside the picture",
     "",
     set_panel,
     {.now = [](const Viewer& v) { return std::string(panel_names[static_cast<std::size_t>(v.session().panel)]); },
      .is_for_scripts = true}},
    {"style-panel",
     "",
     "Painting",
     "Style panel",
     "S",
     [](Viewer& v, const Words&) { toggle(v, Panel::style); },
     {.now = [](const Viewer& v) { return on_or_off(v.session().panel == Panel::style); }, .icon = "style"}},
    {"depth-panel",
     "",
     "Depth",
     "Depth panel",
     "D",
     [](Viewer& v, const Words&) { toggle(v, Panel::depth); },
     {.now = [](const Viewer& v) { return on_or_off(v.session().panel == Panel::depth); }, .icon = "depth"}},
    {"depth-mapping",
     "SHARE:MM,...|comfortable|reset",
     "Depth",
     "Depth mapping: depths behind the screen of parts of the scene, from 0, the nearest, to 1",
     "",
     map_depth,
     {.choices = mapping_choices}},
    {"particles-panel",
     "",
     "Particles",
     "Particles panel",
     "P",
     [](Viewer& v, const Words&) { toggle(v, Panel::particles); },
     {.now = [](const Viewer& v) { return on_or_off(v.session().panel == Panel::particles); }, .applies = shows_scene}},
    {"comfort", "", "Depth", "Tell whether the depth is comfortable", "",
     [](Viewer& v, const Words&) { v.tell(comfort_told(v)); }},
    {"crosstalk",
     "PERCENT",
     "Depth",
     "Crosstalk: light of the neighbouring views in each eye, in %",
     "",
     [](Viewer& v, const Words& w) { state_of(v).crosstalk = static_cast<float>(number_of(w[0], 0, 50) / 100); },
     {.now = [](const Viewer& v) { return fmt::format("{}", 100 * v.session().state.crosstalk); },
      .range = {0, 25, 1}}},
    {"layers-apart", "ANGLE|off", "Painting", "Look at the layers of strokes from a side, in degrees", "",
     set_layers_apart},
    {"side-view",
     "",
     "Painting",
     "Layers from the side",
     "A",
     [](Viewer& v, const Words&) {
       float& angle = state_of(v).layers_apart_deg;
       angle = angle == 0 ? usual_angle_deg : 0;
     },
     {.now = [](const Viewer& v) { return on_or_off(v.session().state.layers_apart_deg != 0); }, .begins_group = true}},
};

}  // namespace

std::span<const Command> painting_commands() { return painting_table; }

std::span<const Command> depth_commands() { return depth_table; }

std::span<const Command> panel_commands() { return panel_table; }

}  // namespace wheatstone::viewer
