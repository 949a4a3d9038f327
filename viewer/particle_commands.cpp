#include <algorithm>
#include <cmath>

#include "command_groups_internal.h"

namespace wheatstone::viewer {
namespace {

void orbit(Viewer& viewer, const Words& words) {
  Framing& framing = state_of(viewer).orbit;
  framing.azimuth_deg = static_cast<float>(std::remainder(framing.azimuth_deg + number_of(words[0]), 360));
  framing.elevation_deg = static_cast<float>(std::clamp(framing.elevation_deg + number_of(words[1]), -89., 89.));
}

constexpr Command table[] = {
    // name, arguments, menu, text, keys
    {"orbit", "AZIMUTH ELEVATION", "Particles", "Turn around the particles, in degrees", "", orbit},
    {"magnify", "FACTOR", "Particles", "Magnification of particles", "",
     [](Viewer& v, const Words& w) { state_of(v).orbit.zoom = static_cast<float>(number_of(w[0], 0.01, 1e6)); }},
};

}  // namespace

std::span<const Command> particle_commands() { return table; }

}  // namespace wheatstone::viewer
