#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command_groups_internal.h"
#include "particle_moves.h"
#include "particle_scene.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

void orbit(Viewer& viewer, const Words& words) {
  wheatstone::Framing& framing = state_of(viewer).orbit;
  framing.azimuth_deg = static_cast<float>(std::remainder(framing.azimuth_deg + number_of(words[0]), 360));
  framing.elevation_deg = static_cast<float>(std::clamp(framing.elevation_deg + number_of(words[1]), -89., 89.));
}

void look_at(Viewer& viewer, const Words& words) {
  const Particles* const particles = open_particles(viewer);
  if (particles == nullptr) throw Error(ErrorKind::wrong_usage, "no particles are open");
  std::array<float, 3> point{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = static_cast<float>(number_of(words[axis]) - particles->cloud.origin[axis]);
  state_of(viewer).orbit.look_at = point;
}

void look_at_place(Viewer& viewer, const Words& words) {
  const Particles* const particles = open_particles(viewer);
  const std::optional<PlaceInView> place = place_at(frame_of(viewer).places, number_of(words[0]), number_of(words[1]));
  if (particles == nullptr || !place) return;
  const std::optional<SeenParticle> seen =
      particle_at(*particles, particle_scene(*particles, state_of(viewer), eyes_of(viewer)), *place);
  if (!seen) {
    viewer.tell("there are no particles there");
    return;
  }
  state_of(viewer).orbit.look_at = seen->position;
}

/// "auto", or a number.
std::optional<float> number_or_auto(const std::string& word, double least, double most) {
  if (word == "auto") return {};
  return static_cast<float>(number_of(word, least, most));
}

void set_colours(Viewer& viewer, const Words& words) {
  const std::string name = words[0] == "auto" ? std::string() : words[0];
  make_splat_style({.colour_map = name}, {});  // which there is
  state_of(viewer).look.colours = name;
}

void set_splat(Viewer& viewer, const Words& words) {
  const std::size_t comma = words[0].find(',');
  if (comma == std::string::npos)
    throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected MIN,MAX", words[0]));
  const auto smallest = static_cast<float>(number_of(words[0].substr(0, comma), 0.01, SplatStyle::widest_px));
  const auto largest = static_cast<float>(number_of(words[0].substr(comma + 1), 0.01, SplatStyle::widest_px));
  if (smallest > largest)
    throw Error(ErrorKind::wrong_usage, fmt::format("is '{}', expected MIN,MAX with MIN <= MAX", words[0]));
  state_of(viewer).look.smallest_px = smallest;
  state_of(viewer).look.largest_px = largest;
}

/// Changes where the colours begin or end. Throws where the colours would end before they begin.
void set_limit(Viewer& viewer, std::optional<float> ParticleLook::*limit, const std::string& word) {
  ViewState changed = state_of(viewer);
  changed.look.*limit = number_or_auto(word, -1e30, 1e30);
  if (const Particles* const particles = open_particles(viewer)) particle_scene(*particles, changed, eyes_of(viewer));
  state_of(viewer).look = changed.look;
}

/// Changes how deep particles or slices stand. Throws where a display cannot show it.
void set_depth(Viewer& viewer, std::optional<float> ParticleLook::*length_mm, const std::string& word) {
  ViewState changed = state_of(viewer);
  changed.look.*length_mm = number_or_auto(word, 0, 1e9);
  mapping_for(perceived_depth(changed), eyes_of(viewer).width, 1, 2);
  state_of(viewer).look = changed.look;
}

/// For what has no effect on mass. Throws Error{wrong_usage} where that is shown.
ParticleLook& thesis_look_of(Viewer& viewer) {
  ParticleLook& look = state_of(viewer).look;
  if (drawn_look(look) != Look::thesis) throw Error(ErrorKind::wrong_usage, "it works with 'look thesis'");
  return look;
}

void set_opaque(Viewer& viewer, const Words& words) {
  ParticleLook& look = state_of(viewer).look;
  look.opaque = switch_of(words[0]);
  forget_brightness(look);
}

constexpr Command particle_table[] = {
    // name, arguments, menu, text, keys
    {"orbit", "AZIMUTH ELEVATION", "Particles", "Turn around the particles, in degrees", "", orbit},
    {"magnify", "FACTOR", "Particles", "Magnification of particles", "",
     [](Viewer& v, const Words& w) { state_of(v).orbit.zoom = static_cast<float>(number_of(w[0], 0.01, 1e6)); }},
    {"look-at", "X Y Z", "Particles", "Point in the middle, around which the view turns", "", look_at},
    {"look-at-place", "X Y", "Particles", "Look at what is seen at a place on the screen", "", look_at_place},
    {"exposure", "VALUE|auto", "Particles", "Exposure: factor on the light", "",
     [](Viewer& v, const Words& w) { thesis_look_of(v).exposure = number_or_auto(w[0], 1e-9, 1e9); }},
    {"colours", "NAME|auto", "Particles", "Colour map", "", set_colours},
    {"coldest", "VALUE|auto", "Particles", "Temperature where the colours begin", "",
     [](Viewer& v, const Words& w) { set_limit(v, &ParticleLook::coldest, w[0]); }},
    {"hottest", "VALUE|auto", "Particles", "Temperature where the colours end", "",
     [](Viewer& v, const Words& w) { set_limit(v, &ParticleLook::hottest, w[0]); }},
    {"splat", "MIN,MAX", "Particles", "Smallest and largest diameter of a splat, in pixels", "", set_splat},
    {"opacity", "VALUE", "Particles", "Opacity of the densest particles", "",
     [](Viewer& v, const Words& w) { thesis_look_of(v).opacity = static_cast<float>(number_of(w[0], 1e-6, 1000)); }},
    {"opaque", "on|off", "Particles", "Opaque particles, the nearest hides the others", "", set_opaque},
    {"near", "MM|auto", "Particles", "Depth of particles or slices in front of the screen, in mm", "",
     [](Viewer& v, const Words& w) { set_depth(v, &ParticleLook::near_mm, w[0]); }},
    {"far", "MM|auto", "Particles", "Depth of particles or slices behind the screen, in mm", "",
     [](Viewer& v, const Words& w) { set_depth(v, &ParticleLook::far_mm, w[0]); }},
};

}  // namespace

std::span<const Command> particle_commands() { return particle_table; }

}  // namespace wheatstone::viewer
