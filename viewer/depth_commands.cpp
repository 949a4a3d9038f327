#include <optional>

#include "bridge.h"
#include "command_groups_internal.h"
#include "pointing.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/lenticular.h"

namespace wheatstone::viewer {
namespace {

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

constexpr Command depth_table[] = {
    // name, arguments, menu, text, keys
    {"zero-parallax", "DISPARITY", "Depth", "Disparity on the screen plane, in pixels", "",
     [](Viewer& v, const Words& w) { ease_zero_parallax(v, static_cast<float>(number_of(w[0], -65535, 65535))); }},
    {"zero-parallax-at", "X Y", "Depth", "Bring what lies at a place onto the screen plane", "", zero_parallax_at},
    {"nearer", "", "Depth", "Bring the scene nearer", "Alt+Left, /",
     [](Viewer& v, const Words&) { step_zero_parallax(v, -1); }},
    {"farther", "", "Depth", "Move the scene farther away", "Alt+Right, *",
     [](Viewer& v, const Words&) { step_zero_parallax(v, 1); }},
    {"separation", "EYES", "Depth", "Distance of the eyes, in those of the picture", "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.separation = static_cast<float>(number_of(w[0], 0, 10)); }},
    {"comfortable", "", "Depth", "Comfortable depth", "Home", [](Viewer& v, const Words&) { v.show_comfortably(); }},
    {"vertical", "PIXELS", "Depth", "Move the right eye's picture down, in screen pixels", "",
     [](Viewer& v, const Words& w) {
       state_of(v).adjustment.vertical_px = static_cast<float>(number_of(w[0], -1000, 1000));
     }},
    {"roll", "DEGREES", "Depth", "Turn the right eye's picture clockwise", "",
     [](Viewer& v, const Words& w) { state_of(v).adjustment.roll_deg = static_cast<float>(number_of(w[0], -45, 45)); }},
    {"head", "X", "Depth", "Position of the head, in eye separations", "",
     [](Viewer& v, const Words& w) { state_of(v).head = static_cast<float>(number_of(w[0], -100, 100)); }},
    {"head-left", "", "Depth", "Move the head to the left", "Left", [](Viewer& v, const Words&) { move_head(v, -1); }},
    {"head-right", "", "Depth", "Move the head to the right", "Right",
     [](Viewer& v, const Words&) { move_head(v, 1); }},
    {"display", "NAME", "Depth", "Display", "",
     [](Viewer& v, const Words& w) { state_of(v).display = find_display(w[0]).name; }},
    {"screen", "NAME|FILE|bridge", "Depth", "Lenticular screen, or its calibration, or that of Looking Glass Bridge",
     "",
     [](Viewer& v, const Words& w) {
       if (w[0] == "bridge") return use_screen_of_bridge(v);
       find_lenticular(w[0]);
       state_of(v).screen = w[0];
     }},
    {"lens-simulator", "on|off", "Depth", "Show what the eyes see through the display's lenses", "",
     [](Viewer& v, const Words& w) { state_of(v).quantised = switch_of(w[0]); }},
};

}  // namespace

std::span<const Command> depth_commands() { return depth_table; }

}  // namespace wheatstone::viewer
